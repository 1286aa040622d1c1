//! A name that is not in the library, and what may have been meant.

use std::fmt;

use super::Library;

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
    let plain = |name: &str| name.to_lowercase().replace(['_', ' '], "-");
    let wanted = plain(asked);
    let mut near: Vec<(f64, &str)> = library
        .iter()
        .map(|entry| {
            // `paper-white` is near `rgl/paper_white`.
            let (name, bare) = (plain(&entry.name), plain(entry.name.rsplit('/').next().unwrap_or_default()));
            let score = strsim::normalized_damerau_levenshtein(&wanted, &name)
                .max(strsim::normalized_damerau_levenshtein(&wanted, &bare));
            (score, entry.name.as_str())
        })
        .filter(|(score, _)| *score >= 0.6)
        .collect();
    near.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    UnknownMaterial {
        name: asked.to_owned(),
        suggestions: near.into_iter().take(3).map(|(_, name)| name.to_owned()).collect(),
        materials: library.len(),
    }
}
