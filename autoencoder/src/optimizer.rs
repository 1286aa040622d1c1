//! AdamW whose state can be saved, so that an interrupted training goes on with the same bits.
//!
//! I. Loshchilov, F. Hutter, *Decoupled Weight Decay Regularization* (2019), algorithm 2. candle's own keeps its moments
//! to itself.

use candle_core::backprop::GradStore;
use candle_core::{DType, Device, Result, Tensor, Var};

use crate::parameters::Parameters;

const DECAY_MEAN: f64 = 0.9;
const DECAY_SQUARE: f64 = 0.999;
const WEIGHT_DECAY: f64 = 1e-2;
/// Gradients longer than this are shortened to it.
const CLIP: f64 = 1.0;

/// First and second moments of all parameters, in their order.
pub(crate) struct AdamW {
    pub mean: Vec<Tensor>,
    pub square: Vec<Tensor>,
    pub step: usize,
}

impl AdamW {
    /// At rest.
    pub fn new(parameters: &Parameters) -> Result<Self> {
        let zero = |(_, var): (&str, &Var)| Tensor::zeros(var.shape(), DType::F32, &Device::Cpu);
        let zeros = || parameters.iter().map(zero).collect::<Result<Vec<_>>>();
        Ok(Self { mean: zeros()?, square: zeros()?, step: 0 })
    }

    /// One step downhill; the gradient's norm is clipped first.
    pub fn step(&mut self, parameters: &Parameters, gradients: &GradStore, rate: f64) -> Result<()> {
        self.step += 1;
        let mut square_norm = 0.0;
        for (_, var) in parameters.iter() {
            if let Some(gradient) = gradients.get(var) {
                square_norm += f64::from(gradient.sqr()?.sum_all()?.to_scalar::<f32>()?);
            }
        }
        let shrink = (CLIP / (square_norm.sqrt() + 1e-12)).min(1.0);
        let mean_bias = 1.0 - DECAY_MEAN.powi(self.step as i32);
        let square_bias = 1.0 - DECAY_SQUARE.powi(self.step as i32);
        for (index, (_, var)) in parameters.iter().enumerate() {
            let Some(gradient) = gradients.get(var) else { continue };
            let gradient = (gradient * shrink)?.detach();
            self.mean[index] = ((&self.mean[index] * DECAY_MEAN)? + (&gradient * (1.0 - DECAY_MEAN))?)?;
            self.square[index] = ((&self.square[index] * DECAY_SQUARE)? + (gradient.sqr()? * (1.0 - DECAY_SQUARE))?)?;
            let towards = ((&self.mean[index] / mean_bias)? / ((&self.square[index] / square_bias)?.sqrt()? + 1e-8)?)?;
            let decayed = (var.as_tensor() * (1.0 - rate * WEIGHT_DECAY))?;
            var.set(&(decayed - (towards * rate)?)?.detach())?;
        }
        Ok(())
    }
}
