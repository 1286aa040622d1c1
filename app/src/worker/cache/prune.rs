//! Bounds the folder: what was not used for the longest time goes first.

use std::fs::{File, FileTimes};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::{Cache, Kind};

/// Bytes of all files together that stay when the program starts.
const KEPT_BYTES: u64 = 64 << 20;

impl Cache {
    /// Removes files that were not used for the longest time, until the others have [`KEPT_BYTES`]. Nobody is told of a file
    /// that cannot be removed: it only takes room.
    pub(in crate::worker) fn prune(&self) {
        self.prune_to(KEPT_BYTES);
    }

    fn prune_to(&self, most: u64) {
        let Some(Ok(found)) = self.0.as_ref().map(std::fs::read_dir) else { return };
        // Whatever else is in the folder is somebody else's.
        let is_own =
            |path: &Path| Kind::ALL.iter().any(|kind| path.extension().is_some_and(|own| own == kind.extension()));
        let file = |path: PathBuf| {
            let about = path.metadata().ok()?;
            let used = about.modified().into_iter().chain(about.accessed()).max()?;
            Some((used, about.len(), path))
        };
        let paths = found.flatten().map(|entry| entry.path()).filter(|path| is_own(path));
        let mut files: Vec<_> = paths.filter_map(file).collect();
        files.sort_by(|a, b| b.cmp(a));
        let mut sum = 0;
        for (_, bytes, path) in files {
            sum += bytes;
            if sum > most {
                let _ = std::fs::remove_file(path);
            }
        }
    }
}

/// Takes note that a file was used: many systems do not do so by themselves.
pub(super) fn touch(file: &Path) {
    let now = FileTimes::new().set_accessed(SystemTime::now());
    let _ = File::options().append(true).open(file).and_then(|file| file.set_times(now));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_used_for_the_longest_time_goes_first_and_foreign_files_stay() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache(Some(folder.path().to_owned()));
        std::fs::write(folder.path().join("notes.txt"), [0; 500]).unwrap();
        let old = SystemTime::now() - std::time::Duration::from_secs(1000);
        for (age, key) in ["a", "b", "c"].into_iter().enumerate() {
            cache.put(Kind::Thumbnail, key, &[0; 36]);
            let used = old + std::time::Duration::from_secs(age as u64);
            let file = File::options().append(true).open(cache.file(Kind::Thumbnail, key).unwrap()).unwrap();
            file.set_times(FileTimes::new().set_accessed(used).set_modified(used)).unwrap();
        }
        assert!(cache.get(Kind::Thumbnail, "a").is_some(), "the oldest is used again");
        cache.prune_to(200);
        let is_there = ["a", "b", "c"].map(|key| cache.get(Kind::Thumbnail, key).is_some());
        assert_eq!(is_there, [true, false, true]);
        assert!(folder.path().join("notes.txt").exists());
        Cache(Some(folder.path().join("none"))).prune();
        Cache::default().prune();
    }
}
