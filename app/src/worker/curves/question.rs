//! What somebody wants to know of some ends and the ways between them, and what was found.

use std::sync::Arc;

use nbrdf_core::Weights;

use super::{Along, Price, Profile, Told};
use crate::worker::here::Here;
use crate::worker::paths::Key;
use crate::worker::picture::Picture;
use crate::worker::{Card, Timing, Walk};

/// What somebody wants to know of some ends and the ways between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Names of the ends, two or more.
    pub ends: Arc<[String]>,
    /// Catalog names of the interpolations.
    pub methods: Vec<&'static str>,
    /// How t runs.
    pub timing: Timing,
    /// Its time and edits, for figures of one point; others are of paths as they are.
    pub walk: Walk,
    /// What of them.
    pub topic: Topic,
}

/// What of some ends and the ways between them.
#[derive(Clone, Debug, PartialEq)]
pub enum Topic {
    /// How good the paths are, over t.
    Along {
        /// Whether beyond the ends too.
        is_beyond: bool,
    },
    /// f_r \[1/sr\] over the view in the plane of incidence.
    Lobe {
        /// Where between the ends.
        weights: Weights,
        /// Polar angle of the light \[degrees\].
        theta_i: f32,
    },
    /// f_r \[1/sr\] over the half vector's polar angle.
    Half {
        /// Where between the ends.
        weights: Weights,
        /// Angle between light and half vector \[degrees\].
        theta_d: f32,
    },
    /// Pictures of f_r over half and difference angles.
    Slice {
        /// Where between the ends.
        weights: Weights,
        /// Exposure in stops.
        exposure: f32,
    },
    /// Directional albedo over the view.
    Albedo {
        /// Where between the ends.
        weights: Weights,
    },
    /// What evaluation costs in the middle.
    Cost,
    /// What is to be said of the ends and the points between.
    Warnings {
        /// Where between the ends.
        weights: Weights,
    },
}

impl Topic {
    /// Where between the ends; none of whole paths.
    pub const fn weights(&self) -> Option<&Weights> {
        match self {
            Self::Along { .. } | Self::Cost => None,
            Self::Lobe { weights, .. }
            | Self::Half { weights, .. }
            | Self::Slice { weights, .. }
            | Self::Albedo { weights }
            | Self::Warnings { weights } => Some(weights),
        }
    }
}

impl Question {
    /// What a method's path between the ends is prepared from.
    pub(in crate::worker) fn key(&self, method: &'static str) -> Key {
        Key::new(&self.ends, method, self.timing)
    }

    /// A place of a method's path, walked like this.
    pub(super) fn here<'a>(&self, method: &'static str, walk: &'a Walk, weights: &'a Weights) -> Here<'a> {
        Here { key: self.key(method), walk, weights }
    }
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Findings {
    /// To which question.
    pub question: Question,
    /// Whether nothing finer will come.
    pub is_fine: bool,
    /// How many of the paths are still being prepared.
    pub waiting: usize,
    /// The answer.
    pub found: Found,
}

/// An answer.
#[derive(Clone, Debug)]
pub enum Found {
    /// To [`Topic::Along`].
    Walks(Vec<Arc<Along>>),
    /// To [`Topic::Lobe`], [`Topic::Half`] and [`Topic::Albedo`].
    Profiles(Vec<Profile>),
    /// To [`Topic::Slice`].
    Slices(Vec<(Card, Picture)>),
    /// To [`Topic::Cost`].
    Prices(Vec<Price>),
    /// To [`Topic::Warnings`].
    Told(Vec<Told>),
    /// There is none, for this reason.
    Nothing(String),
}
