//! Files that are either whole or not there.

use std::{
    fs::{self, File, OpenOptions},
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
    stage(&path, bytes)?.persist(&path).map_err(|failed| failed.error)?;
    Ok(())
}

/// Writes files that mean something together only. All are complete before any gets its name, and the first is away while
/// the others do: whoever is stopped between leaves a set that lacks a file, never one of old and new files.
///
/// # Errors
/// As [`write()`]. Before the first file is taken away, nothing is touched.
pub fn write_together(files: &[(PathBuf, Vec<u8>)]) -> Result<()> {
    let Some((first, _)) = files.first() else { return Ok(()) };
    let _held = hold(folder_of(first));
    let staged = files.iter().map(|(path, bytes)| {
        let path = behind_links(path)?;
        if path.is_dir() {
            return Err(Error::new(ErrorKind::IsADirectory, format!("{} is a folder", path.display())));
        }
        let file = stage(&path, bytes)?;
        Ok((path, file))
    });
    let staged = staged.collect::<Result<Vec<_>>>()?;
    match fs::remove_file(behind_links(first)?) {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    // The first comes last.
    for (path, file) in staged.into_iter().rev() {
        file.persist(path).map_err(|failed| failed.error)?;
    }
    Ok(())
}

/// A folder that others wait for, until this is dropped or its process ends.
#[must_use]
pub struct Held(#[expect(dead_code, reason = "holds by being open")] Option<File>);

/// Keeps others from replacing a folder's files together while this does. Where a file system knows no locks, there is none.
pub fn hold(folder: &Path) -> Held {
    Held(File::open(folder).ok().filter(|folder| uninterrupted(|| folder.lock())))
}

/// Keeps others from replacing a folder's files together while they are read, by any number of readers at once.
pub(crate) fn hold_to_read(folder: &Path) -> Held {
    Held(File::open(folder).ok().filter(|folder| uninterrupted(|| folder.lock_shared())))
}

/// Whether a lock was taken; a signal while waiting is no reason to go on without.
fn uninterrupted(lock: impl Fn() -> Result<()>) -> bool {
    loop {
        match lock() {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            other => return other.is_ok(),
        }
    }
}

/// A complete file under a temporary name.
fn stage(path: &Path, bytes: &[u8]) -> Result<NamedTempFile> {
    let mut file = beside(path)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    Ok(file)
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
    let folder = folder_of(path);
    if !folder.is_dir() {
        let what = format!("the folder {} does not exist: create it first", folder.display());
        return Err(Error::new(ErrorKind::NotFound, what));
    }
    ordinary_permissions(&mut Builder::new()).prefix(".nbrdf-").tempfile_in(folder)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
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

    use super::{check, hold, write, write_together};

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
    fn a_set_is_replaced_as_a_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let set = |text: &str| ["a", "b", "c"].map(|name| (folder.path().join(name), text.as_bytes().to_vec()));
        for text in ["old", "new"] {
            write_together(&set(text)).unwrap();
            assert!(set(text).iter().all(|(path, bytes)| fs::read(path).unwrap() == *bytes));
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
        // A file that cannot be staged keeps all others as they are.
        let mut bad = set("bad").to_vec();
        bad[2].0 = folder.path().join("nowhere/c");
        assert!(write_together(&bad).is_err());
        assert!(set("new").iter().all(|(path, bytes)| fs::read(path).unwrap() == *bytes));
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_that_is_held_is_waited_for() {
        let folder = tempfile::tempdir().unwrap();
        let held = hold(folder.path());
        let other = std::fs::File::open(folder.path()).unwrap();
        assert!(matches!(other.try_lock(), Err(std::fs::TryLockError::WouldBlock)));
        drop(held);
        other.try_lock().unwrap();
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
