//! How to train, and on what.

use std::sync::Arc;

use nbrdf_core::{Brdf, Material, Nbrdf};

use crate::Architecture;
use crate::model::DIM;

/// How to train.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct TrainOptions {
    /// Which autoencoder.
    pub architecture: Architecture,
    /// Numbers in a code; the published architecture has 32.
    pub dim: usize,
    /// Gradient steps.
    pub steps: usize,
    /// Largest learning rate.
    pub rate: f64,
    /// Seed of initial values, directions and augmentation.
    pub seed: u64,
    /// Share of each batch that is analytic materials (ours only), 0..1.
    pub analytic_share: f32,
    /// Whether a part of a code should serve alone (ours only): every row of a batch is decoded from what a shorter code,
    /// of a length drawn anew, keeps of the shared numbers and of each channel's, the others 0 (O. Rippel, M. Gelbart,
    /// R. Adams, *Learning Ordered Representations with Nested Dropout*, 2014).
    #[serde(default)]
    pub ordered: bool,
}

impl TrainOptions {
    /// What the built-in checkpoints were trained with.
    pub const fn new(architecture: Architecture) -> Self {
        let (steps, rate) = match architecture {
            Architecture::Znbrdf => (48_000, 1.5e-3),
            Architecture::Published => (8_000, 1e-3),
        };
        Self { architecture, dim: DIM, steps, rate, seed: 0, analytic_share: 0.08, ordered: false }
    }
}

/// Two materials, and the one that lies between them.
pub struct Walk {
    /// The materials.
    pub ends: [Arc<dyn Brdf>; 2],
    /// How far from the first to the second, 0..1.
    pub t: f32,
    /// The material there.
    pub between: Arc<dyn Brdf>,
}

/// What is learned from.
pub struct TrainingData<'a> {
    /// Materials; the published architecture uses only those with a network.
    pub measured: &'a [Material],
    /// Analytic materials beside them.
    pub analytic: &'a [Arc<dyn Brdf>],
    /// Walks between analytic materials: the decoded mix of two codes is compared with the true material between.
    pub walks: &'a [Walk],
    /// Networks whose weights set the start and the spread of decoded weights.
    pub networks: &'a [Nbrdf],
    /// The shared start of those networks, where they have one.
    pub start: Option<&'a Nbrdf>,
}
