//! Files by what they really are, so that one that is reached by two paths is opened once.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// The path under which each file was opened first.
#[derive(Clone, Default)]
pub(super) struct Opened(Arc<Mutex<HashMap<PathBuf, PathBuf>>>);

impl Opened {
    /// The path that a file is known by.
    pub fn path(&self, path: PathBuf) -> PathBuf {
        // A file that is missing is known by nothing but its path.
        let Ok(real) = path.canonicalize() else { return path };
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let first = known.entry(real.clone()).or_insert_with(|| path.clone());
        // A link may lead elsewhere by now.
        if first.canonicalize().ok() != Some(real) {
            *first = path;
        }
        first.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_one_path_however_it_is_reached() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ours.npz");
        std::fs::write(&path, "").unwrap();
        std::fs::create_dir(folder.path().join("deep")).unwrap();
        let opened = Opened::default();
        assert_eq!(opened.path(path.clone()), path);
        assert_eq!(opened.path(folder.path().join("deep").join("..").join("ours.npz")), path);
        #[cfg(unix)]
        {
            let link = folder.path().join("link.npz");
            let other = folder.path().join("other.npz");
            std::fs::write(&other, "").unwrap();
            std::os::unix::fs::symlink(&other, &link).unwrap();
            assert_eq!([opened.path(link.clone()), opened.path(other.clone())], [link.clone(), link.clone()]);
            std::fs::remove_file(&link).unwrap();
            assert_eq!(opened.path(other.clone()), other, "the link is gone");
        }
        let none = folder.path().join("none.npz");
        assert_eq!(opened.path(none.clone()), none);
    }
}
