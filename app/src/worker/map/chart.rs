//! Two ways to lay codes out in a plane.

use std::sync::Arc;

use anyhow::{Context, Result};
use nbrdf_core::representation::charting::Charting;
use nbrdf_core::representation::pca::Pca;
use nbrdf_core::{Material, Representation as _};
use serde::{Deserialize, Serialize};

use super::Encoded;
use crate::catalog::Catalog;

/// How materials are laid out in a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Projection {
    /// The first two principal components of the codes.
    #[default]
    Pca,
    /// Two coordinates on the manifold of log tables.
    Charting,
}

impl Projection {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Pca, Self::Charting];

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Pca => "PCA of codes",
            Self::Charting => "Charting",
        }
    }

    /// One line for people.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Pca => {
                "The two directions in which the ZNBRDF codes of training materials differ most; units of codes"
            }
            Self::Charting => "Two coordinates along the manifold of measured materials, learned from their log tables",
        }
    }
}

/// A map that was learned.
pub(super) enum Chart {
    Pca(Pca),
    Charting(Arc<Charting>),
}

impl Chart {
    /// From the training materials: PCA from those among the encoded ones.
    pub fn learn(projection: Projection, catalog: &Catalog, encoded: &[Encoded]) -> Result<Self> {
        Ok(match projection {
            Projection::Pca => {
                let training = catalog.training_materials();
                let may_learn = |own: &&Encoded| training.iter().any(|other| other.name == own.material.name);
                let codes: Vec<Vec<f32>> = encoded.iter().filter(may_learn).map(|own| own.code.clone()).collect();
                Self::Pca(Pca::learn(codes, 2)?)
            }
            Projection::Charting => Self::Charting(catalog.charting_2()?),
        })
    }

    /// Where a code lies, or the reflectance that is behind it.
    pub fn place(&self, code: &[f32], material: impl FnOnce() -> Result<Material>) -> Result<[f32; 2]> {
        let at = match self {
            Self::Pca(pca) => pca.project(code),
            Self::Charting(charting) => charting.encode(&material()?)?.code,
        };
        let place = at.first_chunk().copied().filter(|place: &[f32; 2]| place.iter().all(|v| v.is_finite()));
        place.context("it has no place that is a number")
    }

    /// The plane in the space of codes, where there is one.
    pub fn pca(&self) -> Option<Pca> {
        match self {
            Self::Pca(pca) => Some(Pca { mean: pca.mean.clone(), components: pca.components.clone() }),
            Self::Charting(_) => None,
        }
    }
}
