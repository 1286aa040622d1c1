//! Files that are either whole or not there.

use std::{
    io::{Error, ErrorKind, Result, Write},
    path::Path,
};

use tempfile::{Builder, NamedTempFile};

/// Writes `bytes` to `path`: into a temporary file of the same folder first, then renamed, so that nothing
/// half-written is ever left under the final name. An existing file is replaced.
///
/// # Errors
/// [`ErrorKind::NotFound`] naming the folder if it does not exist; whatever the file system reports otherwise.
/// The final name is untouched then.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = beside(path)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|failed| failed.error)?;
    Ok(())
}

/// Whether [`write()`] to this path would work, as far as can be told: to be asked before long work, not after it.
///
/// # Errors
/// As [`write()`]; nothing is left behind either way.
pub fn check(path: &Path) -> Result<()> {
    if path.is_dir() {
        return Err(Error::new(ErrorKind::IsADirectory, "is a folder: name a file"));
    }
    beside(path).map(drop)
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
