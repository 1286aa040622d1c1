//! Reading files of which no more is wanted than a limit, whatever the file system says of their length.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The bytes of a file; none where it has more than `limit`, of which no more than these are read.
pub fn read(path: &Path, limit: u64) -> io::Result<Option<Vec<u8>>> {
    read_from(File::open(path)?, limit)
}

/// The same from anything that is read.
pub(crate) fn read_from(reader: impl Read, limit: u64) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    reader.take(limit + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= limit).then_some(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_at_the_limit_is_read_and_a_longer_one_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("five");
        std::fs::write(&path, b"12345").unwrap();
        assert_eq!(read(&path, 5).unwrap().as_deref(), Some(&b"12345"[..]));
        assert_eq!(read(&path, 4).unwrap(), None);
        assert!(read(&folder.path().join("none"), 4).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn an_endless_file_is_given_up() {
        assert_eq!(read(Path::new("/dev/zero"), 1000).unwrap(), None);
    }
}
