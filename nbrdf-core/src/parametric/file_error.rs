//! Why a file is no such material.

/// What a file of parameters lacks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected {expected}, found {found}")]
pub struct FileError {
    /// What should be there.
    pub expected: String,
    /// What is.
    pub found: String,
}

impl FileError {
    pub(super) fn new(expected: impl ToString, found: impl ToString) -> Self {
        Self { expected: expected.to_string(), found: found.to_string() }
    }
}
