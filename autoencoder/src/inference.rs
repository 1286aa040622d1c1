//! Encoding and decoding without the training framework: packed layers, and buffers that are used again.

mod chain;
mod published;
mod znbrdf;

pub(crate) use chain::Chain;

use crate::Architecture;
use crate::checkpoint::{Checkpoint, CheckpointError};

/// A trained autoencoder, ready to be used.
pub(crate) trait Inference: Send + Sync {
    /// Numbers in a code.
    fn dim(&self) -> usize;

    /// Code \[dim\] of one encoder input.
    fn encode(&self, input: &[f32], code: &mut [f32]);

    /// Bytes that decoding reads.
    fn decoder_bytes(&self) -> usize;

    /// Weights \[675\] of one code \[dim\]; allocates nothing after the first call on a thread.
    fn decode(&self, code: &[f32], weights: &mut [f32]);

    /// Weights \[675\] of one code \[dim\], and ∂weights/∂code \[dim, 675\].
    fn linearize(&self, code: &[f32], weights: &mut [f32], by_number: &mut [f32]);
}

/// From a checkpoint of this architecture; every tensor's shape is checked.
pub(crate) fn build(architecture: Architecture, file: &Checkpoint) -> Result<Box<dyn Inference>, CheckpointError> {
    Ok(match architecture {
        Architecture::Znbrdf => Box::new(znbrdf::ZnbrdfInference::new(file)?),
        Architecture::Published => Box::new(published::PublishedInference::new(file)?),
    })
}

#[cfg(test)]
mod tests {
    use candle_core::{Device, Result, Tensor, Var};
    use nbrdf_core::nbrdf::PUBLISHED_WEIGHTS;
    use nbrdf_core::nbrdf::fit::{generator, random_network};
    use rand::RngExt;

    use super::*;
    use crate::model::{CodeLayout, FEATURES, Model, PublishedModel, ZnbrdfModel};

    fn models() -> Vec<(Architecture, Box<dyn Model>)> {
        let rng = &mut generator(3, 0);
        let (start, spread) = (random_network(1, 0), vec![0.3; PUBLISHED_WEIGHTS]);
        let mut models: Vec<(Architecture, Box<dyn Model>)> = Vec::new();
        for dim in [2, 4, 32, 64] {
            let model = ZnbrdfModel::new(CodeLayout::new(dim), start.weights(), &spread, rng);
            models.push((Architecture::Znbrdf, Box::new(model.unwrap())));
        }
        let published = PublishedModel::new(start.weights(), &spread, rng);
        models.push((Architecture::Published, Box::new(published.unwrap())));
        models
    }

    fn random(count: usize) -> Vec<f32> {
        let rng = &mut generator(4, 0);
        (0..count).map(|_| rng.random_range(-1.5..1.5f32)).collect()
    }

    fn assert_close(own: &[f32], other: &Tensor) {
        let other = other.flatten_all().unwrap().to_vec1::<f32>().unwrap();
        assert_eq!(own.len(), other.len());
        for (a, b) in own.iter().zip(other) {
            assert!((a - b).abs() < 1e-4 * (1.0 + b.abs()), "{a} {b}");
        }
    }

    #[test]
    fn codes_and_weights_are_those_of_the_trained_model() -> Result<()> {
        for (architecture, model) in models() {
            let inference = build(architecture, &Checkpoint::of(model.as_ref()).unwrap()).unwrap();
            let (input, shape) = match architecture {
                Architecture::Znbrdf => (random(3 * FEATURES), vec![1, 3, FEATURES]),
                Architecture::Published => (random(PUBLISHED_WEIGHTS), vec![1, PUBLISHED_WEIGHTS]),
            };
            let (mut code, mut weights) = (vec![0.0; inference.dim()], vec![0.0; PUBLISHED_WEIGHTS]);
            inference.encode(&input, &mut code);
            let other = model.encode(&Tensor::from_vec(input, shape, &Device::Cpu)?)?;
            assert_close(&code, &other);
            inference.decode(&code, &mut weights);
            assert_close(&weights, &model.decode(&other)?);
        }
        Ok(())
    }

    #[test]
    fn derivatives_by_the_code_are_those_of_candles_autodiff() -> Result<()> {
        for (architecture, model) in models() {
            let inference = build(architecture, &Checkpoint::of(model.as_ref()).unwrap()).unwrap();
            let dim = inference.dim();
            let code = random(dim);
            let (mut weights, mut by_number) = (vec![0.0; PUBLISHED_WEIGHTS], vec![0.0; dim * PUBLISHED_WEIGHTS]);
            inference.linearize(&code, &mut weights, &mut by_number);
            let var = Var::from_tensor(&Tensor::from_slice(&code, (1, dim), &Device::Cpu)?)?;
            let decoded = model.decode(var.as_tensor())?;
            assert_close(&weights, &decoded);
            for which in [0, 300, 640, PUBLISHED_WEIGHTS - 1] {
                let gradient = decoded.narrow(1, which, 1)?.sum_all()?.backward()?;
                let column: Vec<f32> = by_number.iter().skip(which).step_by(PUBLISHED_WEIGHTS).copied().collect();
                assert_close(&column, gradient.get(&var).unwrap());
            }
        }
        Ok(())
    }
}
