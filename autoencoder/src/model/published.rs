//! The published autoencoder: 675 → 675 → 32 → 100 → 675.
//!
//! Sztrajman et al. (2021), section 4.2. Their code was never published; relu between layers, and inputs and outputs
//! standardized over the training networks, are this project's choice.

use candle_core::{Device, Result, Tensor};
use nbrdf_core::nbrdf::PUBLISHED_WEIGHTS;
use rand::Rng;

use super::{DIM, Model, add_chain, chain};
use crate::activation::Activation;
use crate::parameters::Parameters;

/// Widths of the encoder's layers.
pub(crate) const ENCODER: [usize; 3] = [PUBLISHED_WEIGHTS, PUBLISHED_WEIGHTS, DIM];
/// Widths of the decoder's layers.
pub(crate) const DECODER: [usize; 3] = [DIM, 100, PUBLISHED_WEIGHTS];

/// The trainable tensors, and mean and spread of the training networks' weights.
pub(crate) struct PublishedModel {
    parameters: Parameters,
    mean: Tensor,
    spread: Tensor,
}

impl PublishedModel {
    /// With random initial weights.
    pub fn new(mean: &[f32], spread: &[f32], rng: &mut impl Rng) -> Result<Self> {
        let mut parameters = Parameters::new();
        add_chain(&mut parameters, "encoder", &ENCODER, 1.0, rng)?;
        add_chain(&mut parameters, "decoder", &DECODER, 1.0, rng)?;
        let row = |values: &[f32]| Tensor::from_slice(values, PUBLISHED_WEIGHTS, &Device::Cpu);
        Ok(Self { parameters, mean: row(mean)?, spread: row(spread)? })
    }
}

impl Model for PublishedModel {
    fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    fn constants(&self) -> Vec<(&'static str, &Tensor)> {
        vec![("mean", &self.mean), ("spread", &self.spread)]
    }

    /// Inputs \[rows, 675\]: weights as they come.
    fn encode(&self, input: &Tensor) -> Result<Tensor> {
        let standard = input.broadcast_sub(&self.mean)?.broadcast_div(&self.spread)?;
        chain(&self.parameters, "encoder", 2, &standard, Activation::Relu, None)
    }

    fn decode(&self, code: &Tensor) -> Result<Tensor> {
        let standard = chain(&self.parameters, "decoder", 2, code, Activation::Relu, None)?;
        standard.broadcast_mul(&self.spread)?.broadcast_add(&self.mean)
    }
}
