//! Networks in a zip archive. Nothing is unpacked to disk; an archive that would harm one who does is refused.

use std::{
    io::{Cursor, Read, Seek},
    path::Path,
};

use ::zip::{ZipArchive, result::ZipError};

use super::{
    LibraryError, MAX_ENTRIES,
    scan::{Found, MAX_TOTAL},
};
use crate::bounded;
use crate::nbrdf::file::{Form, MAX_FILE, ReadProblem, limited};

/// Largest archive opened \[bytes\]; the published ones have less than half a million.
const MAX_ARCHIVE: u64 = 64 << 20;

/// Most bytes that deflate makes of one. Entries that unpack to more share their bytes, as only a hostile archive's do.
const MOST_PER_BYTE: u64 = 1032;

/// The files of networks in an archive. Everything else (`.json`, ...) is passed over without being read.
pub(super) fn files(path: &Path) -> Result<Vec<Found>, LibraryError> {
    let bytes = bounded::read(path, MAX_ARCHIVE).map_err(LibraryError::io(path))?;
    let place = path.display().to_string();
    match bytes {
        Some(bytes) => files_in(&place, &bytes),
        None => Err(LibraryError::TooLarge { path: place, limit: MAX_ARCHIVE }),
    }
}

/// The same in the bytes of an archive.
pub(super) fn files_in(place: &str, bytes: &[u8]) -> Result<Vec<Found>, LibraryError> {
    let too_large = |limit| LibraryError::TooLarge { path: place.to_owned(), limit };
    let bad = |found: String| LibraryError::Archive { path: place.to_owned(), found };
    let most = MAX_TOTAL.min(bytes.len() as u64 * MOST_PER_BYTE);
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
    // What was unpacked, and what of it is kept.
    let (mut total, mut kept) = (0, 0);
    for (index, name) in names.iter().enumerate() {
        let (parent, file_name) = name.split_at(name.rfind('/').map_or(0, |slash| slash + 1));
        if Form::of(file_name).is_none() {
            continue;
        }
        let (bytes, cost) = entry(&mut archive, index);
        total += cost;
        kept += bytes.as_ref().map_or(0, Vec::len) as u64;
        if total > MAX_TOTAL || kept > most {
            return Err(too_large(most));
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
