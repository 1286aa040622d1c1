//! What is put under stress, how much of it, and what of that was asked for.

use std::sync::Arc;

use anyhow::Result;
use autoencoder::Autoencoder;
use nbrdf_core::stress::{Group, Hazard, damage, directions, numbers, samples};
use nbrdf_core::{Database, Material, Split};

use super::{Cell, data, decoded, learning, numbers as codes, paths};
use crate::catalog::{Catalog, REPRESENTATIONS, RepresentationEntry};

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Extent {
    /// Held-out materials that are encoded and decoded.
    pub materials: usize,
    /// Of these, those of hazards under which each is encoded many times.
    pub few: usize,
    /// MERL materials between which walks are screened: all pairs of them.
    pub ends: usize,
    /// The worst pairs of the screening, which are rendered; also the pairs of the other hazards of walks.
    pub pairs: usize,
    /// Steps of every training of ZNBRDF.
    pub steps: usize,
}

impl Extent {
    /// What docs/results.md shows.
    pub const FULL: Self = Self { materials: 20, few: 3, ends: 100, pairs: 100, steps: 1000 };
    /// A quick look.
    pub const QUICK: Self = Self { materials: 4, few: 1, ends: 12, pairs: 6, steps: 60 };
}

/// What is put under stress.
pub struct Setup<'a> {
    /// The methods.
    pub catalog: &'a Catalog,
    /// How much of it.
    pub extent: Extent,
    /// Of everything random.
    pub seed: u64,
    /// Names of hazards and of groups; all where none is named.
    pub hazards: Vec<String>,
    /// Names of methods; all where none is named.
    pub methods: Vec<String>,
}

/// Every hazard, in the order of reports.
pub fn hazards() -> Vec<&'static Hazard> {
    let directions = directions::EXPOSURES.iter().map(|exposure| &exposure.hazard);
    let numbers = numbers::RETOLD.iter().map(|retold| &retold.hazard);
    let numbers = numbers.chain(numbers::BRIGHTNESS.iter().map(|(hazard, _)| hazard));
    let numbers = numbers.chain([&numbers::CONSTANT, &numbers::FAR, &numbers::DENORMAL]);
    let data = damage::DAMAGES.iter().map(|damage| &damage.hazard);
    let data = data.chain(samples::LISTS.iter().map(|list| &list.hazard));
    directions
        .chain(numbers)
        .chain(data)
        .chain(&decoded::PHYSICS)
        .chain(&learning::HAZARDS)
        .chain(&paths::HAZARDS)
        .collect()
}

impl Setup<'_> {
    /// Whether a hazard is asked for.
    pub fn wants(&self, hazard: &Hazard) -> bool {
        let is_named = |name: &String| name == hazard.name || name == hazard.group.name();
        self.hazards.is_empty() || self.hazards.iter().any(is_named)
    }

    /// Whether any hazard of a group is.
    pub fn wants_any(&self, group: Group) -> bool {
        hazards().into_iter().any(|hazard| hazard.group == group && self.wants(hazard))
    }

    /// Whether a method is.
    pub fn wants_method(&self, name: &str) -> bool {
        self.methods.is_empty() || self.methods.iter().any(|method| method == name)
    }

    /// The representations that are.
    pub(super) fn representations(&self) -> impl Iterator<Item = &'static RepresentationEntry> {
        REPRESENTATIONS.iter().filter(|entry| self.wants_method(entry.name))
    }

    /// Cells of a group; `done` is called now and then, with what is being measured, and may end the work.
    ///
    /// # Errors
    /// What `done` says, and what keeps a method from being built.
    pub fn measure(&self, group: Group, done: &(dyn Fn(&str) -> Result<()> + Sync)) -> Result<Vec<Cell>> {
        if !self.wants_any(group) {
            return Ok(Vec::new());
        }
        match group {
            Group::Directions | Group::Physics => decoded::cells(self, group, done),
            Group::Numbers => codes::cells(self, done),
            Group::Data => data::cells(self, done),
            Group::Learning => learning::cells(self, done),
            Group::Paths => paths::cells(self, done),
        }
    }

    /// Held-out materials, evenly picked.
    pub(super) fn held_out(&self, count: usize) -> Result<Vec<Material>> {
        let all = self.catalog.reference().of(Database::Merl, Split::HeldOut);
        if all.is_empty() {
            return Err(self.catalog.reference().lacks("held-out MERL materials", "none"));
        }
        Ok(all.iter().step_by(all.len().div_ceil(count)).map(|&material| material.clone()).collect())
    }

    pub(super) fn known(&self) -> Arc<Autoencoder> {
        self.catalog.autoencoder()
    }
}
