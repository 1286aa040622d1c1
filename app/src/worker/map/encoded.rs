//! A material, its code, and what is known of both.

use anyhow::Result;
use nbrdf_core::Material;
use nbrdf_core::Representation as _;
use nbrdf_core::quality::Qualities;

use crate::catalog::Catalog;
use crate::measure::Trust;

/// A material with a place on a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Its name.
    pub name: String,
    /// Its place, in units of the map: +x right, +y up.
    pub at: [f32; 2],
    /// What it looks like.
    pub qualities: Qualities,
    /// `log_error` to expect of its code.
    pub error: f64,
    /// Distance of its code to the nearest one of training; 1 is how far these are from each other.
    pub distance: Option<f64>,
}

/// A material and its ZNBRDF code.
pub(super) struct Encoded {
    pub material: Material,
    pub code: Vec<f32>,
    qualities: Qualities,
    trust: Trust,
}

impl Encoded {
    /// Encodes and measures.
    pub fn of(material: &Material, catalog: &Catalog) -> Result<Self> {
        let known = catalog.autoencoder();
        let code = catalog.representation(known.name(), false)?.encode(material)?;
        let decoded = known.decode(&code)?;
        let trust = Trust::of(material, &code, decoded.as_ref(), &known)?;
        let qualities = Qualities::of(material.brdf.as_ref());
        Ok(Self { material: material.clone(), code: code.code, qualities, trust })
    }

    /// With its place.
    pub fn spot(&self, at: [f32; 2]) -> Spot {
        Spot {
            name: self.material.name.clone(),
            at,
            qualities: self.qualities,
            error: self.trust.expected_log_error,
            distance: self.trust.distance,
        }
    }
}
