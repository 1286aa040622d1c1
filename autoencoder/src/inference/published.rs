//! The published architecture, as described in `model/published.rs`.

use nbrdf_core::nbrdf::PUBLISHED_WEIGHTS;

use super::Inference;
use super::chain::Chain;
use crate::activation::Activation;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::model::DIM;
use crate::model::published::{DECODER, ENCODER};

pub(super) struct PublishedInference {
    encoder: Chain,
    decoder: Chain,
    mean: Vec<f32>,
    spread: Vec<f32>,
}

impl PublishedInference {
    pub fn new(file: &Checkpoint) -> Result<Self, CheckpointError> {
        Ok(Self {
            encoder: Chain::new(file, "encoder", &ENCODER, Activation::Relu)?,
            decoder: Chain::new(file, "decoder", &DECODER, Activation::Relu)?,
            mean: file.tensor("mean", &[PUBLISHED_WEIGHTS])?.to_vec(),
            spread: file.tensor("spread", &[PUBLISHED_WEIGHTS])?.to_vec(),
        })
    }

    fn units(&self) -> impl Iterator<Item = (&f32, &f32)> {
        self.mean.iter().zip(&self.spread)
    }
}

impl Inference for PublishedInference {
    fn dim(&self) -> usize {
        DIM
    }

    fn encode(&self, input: &[f32], code: &mut [f32]) {
        let standard: Vec<f32> =
            input.iter().zip(self.units()).map(|(w, (mean, spread))| (w - mean) / spread).collect();
        self.encoder.apply(&standard, code);
    }

    fn decoder_bytes(&self) -> usize {
        self.decoder.bytes() + size_of_val(&*self.mean) + size_of_val(&*self.spread)
    }

    fn decode(&self, code: &[f32], weights: &mut [f32]) {
        self.decoder.apply(code, weights);
        weights.iter_mut().zip(self.units()).for_each(|(w, (mean, spread))| *w = *w * spread + mean);
    }

    fn linearize(&self, code: &[f32], weights: &mut [f32], by_number: &mut [f32]) {
        let units: Vec<f32> = (0..DIM * DIM).map(|i| f32::from(u8::from(i % (DIM + 1) == 0))).collect();
        self.decoder.linearize(code, &units, weights, by_number);
        weights.iter_mut().zip(self.units()).for_each(|(w, (mean, spread))| *w = *w * spread + mean);
        for row in by_number.chunks_exact_mut(PUBLISHED_WEIGHTS) {
            row.iter_mut().zip(&self.spread).for_each(|(w, spread)| *w *= spread);
        }
    }
}
