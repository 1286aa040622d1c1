//! A name that is not in the library, and what may have been meant.

use std::fmt;

use super::Library;
use crate::near::near;

/// No material of this name.
#[derive(Clone, Debug, PartialEq)]
pub struct UnknownMaterial {
    /// The name asked for.
    pub name: String,
    /// Names that come near, nearest first; at most three.
    pub suggestions: Vec<String>,
    /// How many materials there are.
    pub materials: usize,
}

impl std::error::Error for UnknownMaterial {}

impl fmt::Display for UnknownMaterial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no material `{}` in the library of {}", self.name, self.materials)?;
        if self.suggestions.is_empty() {
            return write!(f, ": `nbrdf list` names them all");
        }
        let quoted: Vec<String> = self.suggestions.iter().map(|name| format!("`{name}`")).collect();
        write!(f, ": did you mean {}?", quoted.join(" or "))
    }
}

pub(super) fn unknown(library: &Library, asked: &str) -> UnknownMaterial {
    let suggestions = near(asked, library.iter().map(|entry| entry.name.as_str()));
    UnknownMaterial {
        name: asked.to_owned(),
        suggestions: suggestions.into_iter().map(str::to_owned).collect(),
        materials: library.len(),
    }
}
