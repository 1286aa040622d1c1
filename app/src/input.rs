//! Files to be read: what is missing is told in one way, whoever asks for it.

use std::fmt::Display;
use std::io::ErrorKind::{NotADirectory, NotFound};
use std::path::Path;

use anyhow::Result;
use nbrdf_core::Library;

use crate::failure::Failure;

/// What a path to a library should lead to.
const LIBRARY: &str = "a library: a folder, an archive or the file of a network";
/// What a path to a checkpoint should lead to.
pub const CHECKPOINT: &str = "a checkpoint or a basis (.safetensors)";

/// The failure of a path at which there is nothing; `more` follows the advice to check it.
pub fn missing(path: impl Display, expected: &str, more: &str) -> Failure {
    Failure::InvalidFile(format!("{path}: expected {expected}, found no such file: check the path{more}"))
}

/// Whether a path leads to nothing, not even to something that cannot be read.
pub fn is_missing(path: &Path) -> bool {
    path.metadata().is_err_and(|error| matches!(error.kind(), NotFound | NotADirectory))
}

/// Refuses a path at which there is nothing; `expected` says what should be there.
///
/// # Errors
/// [`Failure::InvalidFile`].
pub fn check(path: &Path, expected: &str) -> Result<()> {
    if is_missing(path) { Err(missing(path.display(), expected, "").into()) } else { Ok(()) }
}

/// The same, and refuses a folder.
///
/// # Errors
/// [`Failure::InvalidFile`].
pub fn check_file(path: &Path, expected: &str) -> Result<()> {
    if path.is_dir() {
        let path = path.display();
        return Err(Failure::InvalidFile(format!("{path}: expected {expected}, found a folder: name a file")).into());
    }
    check(path, expected)
}

/// The library at a path.
///
/// # Errors
/// That there is none.
pub fn library(path: &Path) -> Result<Library> {
    check(path, LIBRARY)?;
    Ok(Library::load(path)?)
}
