//! Networks in a zip archive. Nothing is unpacked to disk; an archive that would harm one who does is refused.

use std::{
    fs,
    io::{Cursor, Read, Seek},
    path::Path,
};

use ::zip::{ZipArchive, result::ZipError};

use super::{
    LibraryError, MAX_ENTRIES,
    scan::{Found, MAX_TOTAL},
};
use crate::nbrdf::file::{Form, MAX_FILE, ReadProblem, limited};

/// Largest archive opened \[bytes\]; the published ones have less than half a million.
const MAX_ARCHIVE: u64 = 64 << 20;

/// The files of networks in an archive. Everything else (`.json`, ...) is passed over without being read.
pub(super) fn files(path: &Path) -> Result<Vec<Found>, LibraryError> {
    let too_large = |limit| LibraryError::TooLarge { path: path.display().to_string(), limit };
    let bad = |found: String| LibraryError::Archive { path: path.display().to_string(), found };
    let mut bytes = Vec::new();
    let file = fs::File::open(path).map_err(LibraryError::io(path))?;
    file.take(MAX_ARCHIVE + 1).read_to_end(&mut bytes).map_err(LibraryError::io(path))?;
    if bytes.len() as u64 > MAX_ARCHIVE {
        return Err(too_large(MAX_ARCHIVE));
    }
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| bad(error.to_string()))?;
    if archive.len() > MAX_ENTRIES {
        return Err(too_large(MAX_TOTAL));
    }
    if archive.has_duplicate_names() {
        return Err(bad("one name is there twice".to_owned()));
    }
    let names = archive.file_names().map(|name| name.map(|name| name.into_owned()));
    let names: Vec<String> = names.collect::<Result<_, ZipError>>().map_err(|error| bad(error.to_string()))?;
    if let Some(name) = names.iter().find(|name| leads_outside(name)) {
        return Err(bad(format!("the name {name:?} leads outside the archive")));
    }
    let mut found = Vec::new();
    let mut total = 0;
    for (index, name) in names.iter().enumerate() {
        let (parent, file_name) = name.split_at(name.rfind('/').map_or(0, |slash| slash + 1));
        if Form::of(file_name).is_none() {
            continue;
        }
        let (bytes, cost) = entry(&mut archive, index);
        total += cost;
        if total > MAX_TOTAL {
            return Err(too_large(MAX_TOTAL));
        }
        found.push(Found { parent: parent.to_owned(), file_name: file_name.to_owned(), bytes });
    }
    Ok(found)
}

/// An entry's bytes, and how many were unpacked to get them at most. The size in its header is a claim: what counts is
/// what comes out.
fn entry<R: Read + Seek>(archive: &mut ZipArchive<R>, index: usize) -> (Result<Vec<u8>, ReadProblem>, u64) {
    let entry = match archive.by_index(index) {
        Ok(entry) => entry,
        Err(error) => return (Err(ReadProblem::Entry(error.to_string())), 0),
    };
    match limited(entry) {
        Ok(bytes) => {
            let cost = bytes.len() as u64;
            (Ok(bytes), cost)
        }
        Err(ReadProblem::Io(error)) => (Err(ReadProblem::Entry(error.to_string())), MAX_FILE),
        Err(other) => (Err(other), MAX_FILE),
    }
}

/// Names that an unpacking program may write elsewhere: absolute, with `..`, with a drive or the other slash.
fn leads_outside(name: &str) -> bool {
    name.starts_with('/') || name.contains(['\\', '\0', ':']) || name.split('/').any(|part| part == "..")
}
