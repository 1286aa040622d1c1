//! What is put under stress, how much of it, and what of that was asked for.

use std::sync::Arc;

use anyhow::Result;
use autoencoder::Autoencoder;
use nbrdf_core::hash::short_hash;
use nbrdf_core::sampling::{evaluate, rus32k};
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
    /// Mark of the work: what the materials reflect at some directions, the hazards with their thresholds, the version.
    pub fn work(&self) -> String {
        let at: Vec<_> = rus32k().iter().step_by(4096).copied().collect();
        let values = self.catalog.reference().materials.iter().flat_map(|m| evaluate(m.brdf.as_ref(), &at));
        let thresholds = hazards().into_iter().flat_map(|hazard| [hazard.holds as f32, hazard.fails as f32]);
        let names = hazards().into_iter().flat_map(|hazard| hazard.name.bytes()).map(f32::from);
        let mark = short_hash(values.flat_map(|f| f.0).chain(thresholds).chain(names));
        format!("{mark} {}", env!("CARGO_PKG_VERSION"))
    }

    /// How much there is of what is asked for.
    ///
    /// # Errors
    /// Where there are too few materials.
    pub fn counted(&self) -> Result<Extent> {
        let has_walks = self.wants_any(Group::Paths);
        Ok(Extent {
            materials: self.held_out(self.extent.materials)?.len(),
            few: self.held_out(self.extent.few)?.len(),
            ends: if has_walks { paths::merl(self)?.len() } else { 0 },
            ..self.extent
        })
    }

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
