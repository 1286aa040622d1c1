//! Names that may be typed, from the catalog's lists: what else is typed is refused with all of them, and the Tab key offers
//! them.

use clap::builder::PossibleValuesParser;
use nbrdf_core::stress::Group;

use crate::catalog::{Catalog, EXPORTERS, INTERPOLATIONS, REPRESENTATIONS};
use crate::measure::stress;

/// Ways to store a material.
pub fn representations() -> PossibleValuesParser {
    each(REPRESENTATIONS.iter().map(|entry| entry.name))
}

/// Those of them that are learned, and can be saved.
pub fn bases() -> PossibleValuesParser {
    each(Catalog::learned_entries().map(|entry| entry.name))
}

/// Ways between materials.
pub fn interpolations() -> PossibleValuesParser {
    each(INTERPOLATIONS.iter().map(|entry| entry.name))
}

/// Forms that are written.
pub fn forms() -> PossibleValuesParser {
    each(EXPORTERS.iter().map(|entry| entry.name))
}

/// Hazards and kinds of them.
pub fn hazards() -> PossibleValuesParser {
    each(Group::ALL.map(Group::name).into_iter().chain(stress::hazards().into_iter().map(|hazard| hazard.name)))
}

/// What is exposed to hazards.
pub fn methods() -> PossibleValuesParser {
    let (stored, walked) =
        (REPRESENTATIONS.iter().map(|entry| entry.name), INTERPOLATIONS.iter().map(|entry| entry.name));
    each(stored.chain(walked).chain(["reference"]))
}

/// Each once, however many variants a name has.
fn each(names: impl Iterator<Item = &'static str>) -> PossibleValuesParser {
    let mut once: Vec<&str> = Vec::new();
    for name in names {
        if !once.contains(&name) {
            once.push(name);
        }
    }
    once.into()
}
