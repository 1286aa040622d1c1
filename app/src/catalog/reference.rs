//! What errors are measured against: published networks where they are at hand, else the built-in ones.

use std::fmt::Display;
use std::path::Path;

use anyhow::{Error, Result};
use nbrdf_core::library::builtin;
use nbrdf_core::{Database, Library, Material, Split, data};

use crate::failure::Failure;
use crate::input;

/// The reference materials and where they come from.
pub struct Reference {
    /// `published`, `builtin`, or the path given: the report's key `reference`.
    pub kind: String,
    /// All materials, ordered by database and name.
    pub materials: Vec<Material>,
}

impl Reference {
    /// The library at `path`; without one the published networks in `NBRDF_DATA`; without those the built-in ones.
    pub fn load(path: Option<&Path>) -> Result<Self> {
        if let Some(path) = path {
            return Ok(Self { kind: path.display().to_string(), materials: input::library(path)?.materials() });
        }
        let published = ["merl_nbrdf.zip", "rgl_nbrdf_subset.zip"].map(data::published);
        let [Some(merl), Some(rgl)] = published else { return Ok(Self::built_in()) };
        let mut materials = Library::load(&merl)?.materials();
        materials.extend(Library::load(&rgl)?.materials());
        Ok(Self { kind: "published".to_owned(), materials })
    }

    /// The built-in networks.
    pub fn built_in() -> Self {
        Self { kind: "builtin".to_owned(), materials: builtin::shared().materials() }
    }

    /// The failure of a command that needs materials which are not there.
    pub fn lacks(&self, expected: &str, found: impl Display) -> Error {
        Failure::InvalidFile(format!("reference '{}': expected {expected}, found {found}", self.kind)).into()
    }

    /// The materials of a database in a split.
    pub fn of(&self, database: Database, split: Split) -> Vec<&Material> {
        let chosen = |m: &&Material| Database::of(&m.name) == database && Split::of(&m.name) == split;
        self.materials.iter().filter(chosen).collect()
    }
}
