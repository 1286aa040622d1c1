//! A material, and where it comes from.

use anyhow::Result;
use nbrdf_core::library::Entry;
use nbrdf_core::metric::{albedo_max, albedo_max_around};
use nbrdf_core::{Code, Material, Split};

use super::split_of;
use crate::failure::Failure;

/// A material, and where it comes from.
pub struct Item {
    /// The reflectance, and the network where there is one.
    pub material: Material,
    /// Its line in a library.
    pub entry: Option<Entry>,
    /// Its code, if a code was named.
    pub code: Option<Code>,
    /// Whether it changes when it is turned: then it has no code, and figures of one azimuth say little of it.
    turns: bool,
}

impl Item {
    pub(super) fn of_entry(entry: Entry) -> Self {
        Self { material: entry.material(), entry: Some(entry), code: None, turns: false }
    }

    pub(super) fn of_file(material: Material, turns: bool) -> Self {
        Self { material, entry: None, code: None, turns }
    }

    pub(super) fn of_code(material: Material, code: Code) -> Self {
        Self { material, entry: None, code: Some(code), turns: false }
    }

    /// Itself, if it is the same however it is turned.
    pub(super) fn isotropic(self, argument: &str) -> Result<Self> {
        if self.turns {
            return Err(Failure::InvalidFile(format!(
                "{argument}: expected an isotropic material, found one that changes when it is turned: a table of such a \
                 material is fitted by `nbrdf fit`, table and network are shown by `nbrdf render`; it has no code"
            ))
            .into());
        }
        Ok(self)
    }

    /// Largest albedo: of viewers all around where it changes when it is turned.
    pub fn albedo_max(&self) -> f64 {
        match self.turns {
            true => albedo_max_around(self.material.brdf.as_ref()),
            false => albedo_max(self.material.brdf.as_ref()),
        }
    }

    /// The split it belongs to; none for what is in no standard database.
    pub fn split(&self) -> Option<Split> {
        split_of(&self.material.name)
    }
}
