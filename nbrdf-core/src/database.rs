//! Which collection of measurements a material comes from, told by its name.

mod merl;
mod rgl;

use std::fmt;

use serde::{Deserialize, Serialize};

pub use merl::MERL;
pub use rgl::RGL;

/// A collection of measured materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Database {
    /// One of the 100 names in [`MERL`].
    Merl,
    /// A name that starts with `rgl/`; the 34 at hand are in [`RGL`].
    Rgl,
    /// Anything else.
    Other,
}

impl Database {
    /// The database of a material's name (`chrome`, `rgl/paper_white`, `my-paint`).
    pub fn of(name: &str) -> Self {
        if MERL.binary_search(&name).is_ok() {
            Self::Merl
        } else if name.starts_with("rgl/") {
            Self::Rgl
        } else {
            Self::Other
        }
    }

    /// The standard names of this database, sorted; none for [`Database::Other`].
    pub const fn names(self) -> &'static [&'static str] {
        match self {
            Self::Merl => &MERL,
            Self::Rgl => &RGL,
            Self::Other => &[],
        }
    }
}

impl fmt::Display for Database {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Merl => "merl",
            Self::Rgl => "rgl",
            Self::Other => "other",
        })
    }
}

/// The name a material goes by, from the stem of its published file: `paper_white_rgb` is `rgl/paper_white`
/// (RGL files end in `_rgb`), every other stem is the name itself.
pub(crate) fn name_from_stem(stem: &str) -> String {
    match stem.strip_suffix("_rgb") {
        Some(name) if !name.is_empty() => format!("rgl/{name}"),
        _ => stem.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_rgl_are_known_by_their_end() {
        assert_eq!(name_from_stem("paper_white_rgb"), "rgl/paper_white");
        assert_eq!(name_from_stem("chrome"), "chrome");
        assert_eq!(name_from_stem("_rgb"), "_rgb");
    }

    #[test]
    fn standard_names_are_sorted_and_know_their_database() {
        for database in [Database::Merl, Database::Rgl] {
            assert!(database.names().is_sorted_by(|a, b| a < b), "{database}");
            assert!(database.names().iter().all(|name| Database::of(name) == database));
        }
    }

    #[test]
    fn unknown_names_belong_to_no_database_but_rgl_is_told_by_its_prefix() {
        assert_eq!(Database::of("my-paint"), Database::Other);
        assert_eq!(Database::of("rgl/not_at_hand"), Database::Rgl);
    }
}
