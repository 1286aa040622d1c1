//! How to train, and on what.

use std::sync::Arc;

use nbrdf_core::{Brdf, Material, Nbrdf};

use crate::Architecture;

/// How to train.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct TrainOptions {
    /// Which autoencoder.
    pub architecture: Architecture,
    /// Gradient steps.
    pub steps: usize,
    /// Largest learning rate.
    pub rate: f64,
    /// Seed of initial values, directions and augmentation.
    pub seed: u64,
    /// Share of each batch that is analytic materials (ours only), 0..1.
    pub analytic_share: f32,
}

impl TrainOptions {
    /// What the built-in checkpoints were trained with.
    pub const fn new(architecture: Architecture) -> Self {
        let steps = match architecture {
            Architecture::Znbrdf => 24_000,
            Architecture::Published => 8_000,
        };
        Self { architecture, steps, rate: 1e-3, seed: 0, analytic_share: 0.15 }
    }
}

/// What is learned from.
pub struct TrainingData<'a> {
    /// Materials; the published architecture uses only those with a network.
    pub measured: &'a [Material],
    /// Analytic materials beside them.
    pub analytic: &'a [Arc<dyn Brdf>],
    /// Networks whose weights set the start and the spread of decoded weights.
    pub networks: &'a [Nbrdf],
    /// The shared start of those networks, where they have one.
    pub start: Option<&'a Nbrdf>,
}
