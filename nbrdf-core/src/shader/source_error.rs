//! Why a text holds no network.

/// What a text of source code lacks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected {expected}, found {found}")]
pub struct SourceError {
    /// What should be there.
    pub expected: String,
    /// What is.
    pub found: String,
}

impl SourceError {
    pub(super) fn new(expected: impl ToString, found: impl ToString) -> Self {
        Self { expected: expected.to_string(), found: found.to_string() }
    }
}
