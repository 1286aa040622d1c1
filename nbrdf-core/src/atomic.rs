//! Files that are either whole or not there.

use std::{
    fs::{self, OpenOptions},
    io::{Error, ErrorKind, Result, Write},
    path::{Path, PathBuf},
};

use tempfile::{Builder, NamedTempFile};

/// Writes `bytes` to `path`: into a temporary file of the same folder first, then renamed, so that nothing
/// half-written is ever left under the final name. An existing file is replaced, behind a symbolic link too; what is
/// no file (a terminal, a pipe, a device) is written to as it is.
///
/// # Errors
/// [`ErrorKind::NotFound`] naming the folder if it does not exist; whatever the file system reports otherwise.
/// The final name is untouched then.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let path = behind_links(path)?;
    if is_no_file(&path) {
        return OpenOptions::new().write(true).open(&path)?.write_all(bytes);
    }
    let mut file = beside(&path)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(&path).map_err(|failed| failed.error)?;
    Ok(())
}

/// Where a symbolic link leads to; another path is itself.
fn behind_links(path: &Path) -> Result<PathBuf> {
    match fs::symlink_metadata(path) {
        // A link to nothing yet: where it points to.
        Ok(found) if found.is_symlink() => fs::canonicalize(path).or_else(|_| {
            let target = fs::read_link(path)?;
            Ok(path.parent().unwrap_or(Path::new(".")).join(target))
        }),
        _ => Ok(path.to_owned()),
    }
}

/// Neither a file nor a folder, but there.
fn is_no_file(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// Whether [`write()`] to this path would work, as far as can be told: to be asked before long work, not after it.
///
/// # Errors
/// As [`write()`]; nothing is left behind either way.
pub fn check(path: &Path) -> Result<()> {
    if path.is_dir() {
        return Err(Error::new(ErrorKind::IsADirectory, "is a folder: name a file"));
    }
    let path = behind_links(path)?;
    // A pipe that is opened now would wait for its reader, and be closed to him again.
    if is_no_file(&path) { Ok(()) } else { beside(&path).map(drop) }
}

/// A temporary file in the folder of `path`.
fn beside(path: &Path) -> Result<NamedTempFile> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let what = format!("the folder {} does not exist: create it first", folder.display());
        return Err(Error::new(ErrorKind::NotFound, what));
    }
    ordinary_permissions(&mut Builder::new()).prefix(".nbrdf-").tempfile_in(folder)
}

/// Temporary files are private to their owner; a finished file should be as readable as any other.
#[cfg(unix)]
fn ordinary_permissions<'a, 'b, 'c>(builder: &'a mut Builder<'b, 'c>) -> &'a mut Builder<'b, 'c> {
    use std::{fs::Permissions, os::unix::fs::PermissionsExt};
    builder.permissions(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn ordinary_permissions<'a, 'b, 'c>(builder: &'a mut Builder<'b, 'c>) -> &'a mut Builder<'b, 'c> {
    builder
}

#[cfg(test)]
mod tests {
    use std::{fs, io::ErrorKind};

    use super::{check, write};

    #[test]
    fn a_written_file_holds_the_bytes_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bin");
        write(&path, b"first").unwrap();
        write(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_what_is_no_file_stays_what_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let [target, link] = ["target", "link"].map(|name| folder.path().join(name));
        write(&target, b"old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        write(&link, b"new").unwrap();
        assert_eq!(fs::read(&target).unwrap(), b"new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        fs::remove_file(&target).unwrap();
        write(&link, b"again").unwrap();
        assert_eq!(fs::read(&target).unwrap(), b"again");
        write(std::path::Path::new("/dev/null"), b"gone").unwrap();
        check(std::path::Path::new("/dev/null")).unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[test]
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let error = write(&folder.path().join("nowhere/a.bin"), b"x").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::NotFound);
        assert!(error.to_string().contains("nowhere"), "{error}");
    }

    #[test]
    fn a_failed_write_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        assert!(write(&path, b"x").is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_check_tells_what_a_write_would_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        check(&folder.path().join("new")).unwrap();
        assert_eq!(check(folder.path()).unwrap_err().kind(), ErrorKind::IsADirectory);
        assert_eq!(check(&folder.path().join("nowhere/new")).unwrap_err().kind(), ErrorKind::NotFound);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
