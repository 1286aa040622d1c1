//! `.npz`: a zip archive of `.npy` files.

use std::io::{Cursor, Read, Write};

use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter, result::ZipError, write::SimpleFileOptions};

use super::{ARRAYS, NpyError, read_npy, write_npy};
use crate::Nbrdf;

/// Largest array read \[bytes\]: 256 × 256 f64 and a header.
const MAX_ARRAY: u64 = 256 * 256 * 8 + 2048;
/// Most entries looked at; other arrays may lie beside the six.
const MAX_ENTRIES: usize = 1024;

impl From<ZipError> for NpyError {
    fn from(error: ZipError) -> Self {
        Self::Archive(error.to_string())
    }
}

/// Reads a network from the bytes of a `.npz` with the arrays of [`ARRAYS`]. Other arrays in it are not looked at.
///
/// # Errors
/// [`NpyError`] if it is no readable archive, an array is missing, unpacks to more than a network needs, or does not
/// fit; see [`read_npy`].
pub fn read_npz(bytes: &[u8]) -> Result<Nbrdf, NpyError> {
    let mut archive = ZipArchive::new(Cursor::new(bytes))?;
    if archive.len() > MAX_ENTRIES || archive.has_duplicate_names() {
        return Err(NpyError::Archive(format!("more than {MAX_ENTRIES} arrays, or one twice")));
    }
    let missing: Vec<String> =
        ARRAYS.iter().filter(|name| archive.index_for_name(&file(name)).is_none()).map(|&name| name.into()).collect();
    if !missing.is_empty() {
        return Err(NpyError::Missing { missing });
    }
    let mut files: [Vec<u8>; 6] = Default::default();
    for (name, out) in ARRAYS.iter().zip(&mut files) {
        // The size in the header is a claim; what counts is what comes out.
        let mut entry = archive.by_name(&file(name))?.take(MAX_ARRAY + 1);
        entry.read_to_end(out).map_err(|error| NpyError::Archive(format!("{name}: {error}")))?;
        if out.len() as u64 > MAX_ARRAY {
            return Err(NpyError::Archive(format!("{name} unpacks to more than {MAX_ARRAY} bytes")));
        }
    }
    let [a, b, c, d, e, f] = &files;
    read_npy([a, b, c, d, e, f])
}

/// The bytes of a `.npz` that numpy and [`read_npz`] read; the same network gives the same bytes.
pub fn write_npz(network: &Nbrdf) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    let written = (|| {
        let mut writer = ZipWriter::new(&mut out);
        let stored = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default());
        for (name, bytes) in ARRAYS.iter().zip(write_npy(network)) {
            writer.start_file(file(name), stored)?;
            writer.write_all(&bytes)?;
        }
        writer.finish().map(|_| ())
    })();
    debug_assert!(written.is_ok(), "writing to memory does not fail: {written:?}");
    out.into_inner()
}

fn file(array: &str) -> String {
    format!("{array}.npy")
}
