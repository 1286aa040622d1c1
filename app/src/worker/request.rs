//! What is to be shown.

use std::sync::Arc;

use nbrdf_core::image::Tone;
use nbrdf_core::render::{Frame, Light};
use nbrdf_core::{Vec3, Weights};
use serde::{Deserialize, Serialize};

use super::picture::Showing;
use super::{Asset, Card, Explored, Walk};

/// What is to be shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Names of the ends, two or more.
    pub ends: Arc<[String]>,
    /// Where between them.
    pub weights: Weights,
    /// How t runs along paths.
    pub timing: Timing,
    /// How paths are walked otherwise.
    pub walk: Walk,
    /// Catalog names of the interpolations.
    pub methods: Vec<&'static str>,
    /// A place of the latent map that is shown as well.
    pub explored: Option<Explored>,
    /// What the materials are seen on, and in which light.
    pub scenery: Scenery,
    /// Exposure in stops.
    pub exposure: f32,
    /// How pictures are shown; figures are those of the clip curve.
    pub tone: Tone,
    /// Side of a sphere's picture in pixels.
    pub size: usize,
    /// Side of the pictures of the film strips in pixels; 0 for no strips.
    pub strip: usize,
    /// Cards that alone are looked at in this size; none for all of them.
    pub closeup: Option<Closeup>,
}

/// Two cards in the place of all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closeup {
    /// They may be the same.
    pub cards: [Card; 2],
    /// How their difference is shown, if it is.
    pub scale: Option<Scale>,
}

/// Where the colours of a difference end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Scale {
    /// At a round number that nothing exceeds.
    #[default]
    Whole,
    /// At this ΔE_ITP; larger differences look like it.
    UpTo(u16),
}

impl Request {
    /// Whether a card is asked for in the full size.
    pub(super) fn is_large(&self, card: Card) -> bool {
        self.closeup.is_none_or(|closeup| closeup.cards.contains(&card))
    }

    /// How linear pictures are shown.
    pub(super) fn showing(&self) -> Showing {
        Showing { stops: self.exposure, tone: self.tone }
    }
}

/// How t runs along a path, from each end to the next.
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
    /// What the materials are seen on.
    #[serde(default)]
    pub shape: Shape,
    /// Which part of it is shown.
    #[serde(default)]
    pub frame: Frame,
}

impl Scenery {
    /// A whole sphere in this light.
    pub const fn of(lighting: Lighting) -> Self {
        Self { lighting, shape: Shape::Sphere, frame: Frame::WHOLE }
    }

    /// The whole sphere in the same light: what figures are measured on.
    pub(super) const fn plain(self) -> Self {
        Self::of(self.lighting)
    }

    /// The whole of the same shape.
    pub(super) const fn whole(self) -> Self {
        Self { frame: Frame::WHOLE, ..self }
    }
}

/// What materials are seen on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Shape {
    /// A sphere, as in reports.
    #[default]
    Sphere,
    /// A ground, seen aslant.
    Plane,
    /// A mesh; the built-in one while its file is missing.
    Mesh(Asset),
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
        /// Which map; the built-in one while its file is missing.
        map: Asset,
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
