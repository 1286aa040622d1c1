//! Files that are no scenes.

use std::io;
use std::path::Path;

use crate::render::environment::EnvironmentError;

/// Why a file is no scene: which file, and what is wrong with it.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {problem}")]
pub struct SceneError {
    /// The scene's file, or the one it names.
    pub file: String,
    /// What is wrong with it.
    pub problem: SceneProblem,
}

/// What is wrong with a file: what was expected, what was found, what to do.
#[derive(Debug, thiserror::Error)]
pub enum SceneProblem {
    /// The file system says no.
    #[error("{}: check the path", unread(.0))]
    Io(#[from] io::Error),
    /// Not TOML, or not of a scene; the message tells line and key.
    #[error("{0}")]
    Syntax(String),
    /// A value out of range, or of no use.
    #[error("{place}: expected {expected}, found {found}")]
    Value {
        /// Where in the file.
        place: String,
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
    },
    /// Files that include each other.
    #[error("includes lead around in a circle ({0}): take one of them out")]
    Circle(String),
    /// A mesh that cannot be read.
    #[error("expected {expected}, found {found}: export the mesh again")]
    Mesh {
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
    },
    /// An environment that cannot be read.
    #[error(transparent)]
    Environment(#[from] EnvironmentError),
}

/// What there was to read.
fn unread(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "expected a file, found no such file".to_owned(),
        _ => format!("cannot be read ({error})"),
    }
}

impl SceneProblem {
    /// The same, with the file it is about.
    pub fn of(self, file: &Path) -> SceneError {
        SceneError { file: file.display().to_string(), problem: self }
    }

    /// A value that was not expected.
    pub(super) fn value(place: impl ToString, expected: impl ToString, found: impl ToString) -> Self {
        Self::Value { place: place.to_string(), expected: expected.to_string(), found: found.to_string() }
    }

    /// A mesh that was not expected.
    pub(super) fn mesh(expected: impl ToString, found: impl ToString) -> Self {
        Self::Mesh { expected: expected.to_string(), found: found.to_string() }
    }
}
