//! What is to be shown.

use std::sync::Arc;

use nbrdf_core::render::Light;
use nbrdf_core::{Vec3, Weights};
use serde::{Deserialize, Serialize};

/// What is to be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Names of the ends, two or more.
    pub ends: Arc<[String]>,
    /// Where between them.
    pub weights: Weights,
    /// How t runs along paths between two ends.
    pub timing: Timing,
    /// Catalog names of the interpolations.
    pub methods: Vec<&'static str>,
    /// What the materials are seen on, and in which light.
    pub scenery: Scenery,
    /// Exposure in stops.
    pub exposure: f32,
    /// Side of a sphere's picture in pixels.
    pub size: usize,
    /// Side of the pictures of the film strips in pixels; 0 for no strips.
    pub strip: usize,
}

/// How t runs along a path between two ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Timing {
    /// As the method has it.
    #[default]
    Straight,
    /// So that equal steps look equally large.
    Even,
}

/// What decides a linear picture, but for its material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scenery {
    /// The light.
    pub lighting: Lighting,
}

/// The light the spheres stand in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Lighting {
    /// The eleven lamps of the reports.
    Studio,
    /// One lamp in this direction: +x right, +y up, +z towards the viewer.
    Point(Vec3),
    /// A map all around, sample after sample.
    Around {
        /// Its place in the list of maps; 0 is the built-in one.
        map: usize,
        /// How far it is turned about the vertical axis \[rad\].
        turn: f32,
    },
}

impl Lighting {
    /// The lamps; none where light comes from all around.
    pub(super) fn lamps(self) -> Option<Light> {
        match self {
            Self::Studio => Some(Light::studio()),
            Self::Point(direction) => Some(Light::directional(direction)),
            Self::Around { .. } => None,
        }
    }
}
