//! The training loss as one candle operation: decoded weights in, one loss per material out.
//!
//! Forward and backward run on the hand-written network gradient of `nbrdf-core`, one material per task.

use std::sync::{Arc, Mutex};

use candle_core::{CpuStorage, CustomOp1, Layout, Result, Shape, Tensor};
use nbrdf_core::Rgb;
use nbrdf_core::nbrdf::corridor::Corridor;
use nbrdf_core::nbrdf::gradient::Backpropagation;
use nbrdf_core::nbrdf::objective::{Objective, features_into, pull_back};
use nbrdf_core::nbrdf::samples::Samples;
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};
use rayon::prelude::*;

/// What one decoded network is compared with.
#[derive(Clone)]
pub(crate) struct Target {
    pub samples: Arc<Samples>,
    pub wanted: Wanted,
    /// How much it counts.
    pub weight: f32,
}

/// What is asked of a decoded network.
#[derive(Clone)]
pub(crate) enum Wanted {
    /// To be this reflectance: its features on the samples.
    Features(Vec<f32>),
    /// To have a mean colour between two others.
    Between(Corridor),
}

struct DecodedLoss {
    objective: Objective,
    targets: Vec<Target>,
    /// ∂loss/∂weights \[rows, 675\], left by the forward pass for the backward pass.
    gradient: Mutex<Vec<f32>>,
}

/// Loss per row \[rows\] of decoded weights \[rows, 675\].
pub(crate) fn decoded_loss(weights: &Tensor, objective: Objective, targets: Vec<Target>) -> Result<Tensor> {
    weights.contiguous()?.apply_op1(DecodedLoss { objective, targets, gradient: Mutex::default() })
}

impl DecodedLoss {
    fn row(&self, weights: &[f32], target: &Target, gradient: &mut [f32]) -> f32 {
        let Target { samples, wanted, weight } = target;
        let mut network = Backpropagation::new(PUBLISHED_HIDDEN);
        let mut values = vec![Rgb::BLACK; samples.at.len()];
        let mut by_value = values.clone();
        network.forward(weights, &samples.at, &mut values);
        let loss = match wanted {
            Wanted::Features(wanted) => {
                let (mut own, mut by_feature) = (vec![0.0; wanted.len()], vec![0.0; wanted.len()]);
                features_into(samples, &values, &mut own);
                let loss = self.objective.loss(samples, &own, wanted, &mut by_feature);
                pull_back(samples, &values, &own, &by_feature, &mut by_value);
                loss
            }
            Wanted::Between(corridor) => corridor.loss(samples, &values, &mut by_value),
        };
        by_value.iter_mut().for_each(|slope| *slope = *slope * *weight);
        network.backward(weights, &samples.at, &by_value, gradient);
        loss as f32 * weight
    }
}

impl CustomOp1 for DecodedLoss {
    fn name(&self) -> &'static str {
        "decoded-loss"
    }

    fn cpu_fwd(&self, storage: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        let rows = self.targets.len();
        let all = storage.as_slice::<f32>()?;
        let Some((start, end)) = layout.contiguous_offsets() else { candle_core::bail!("weights must be contiguous") };
        let weights = &all[start..end];
        if weights.len() != rows * PUBLISHED_WEIGHTS {
            candle_core::bail!("{rows} targets need {} weights, found {}", rows * PUBLISHED_WEIGHTS, weights.len());
        }
        let mut gradient = vec![0.0; weights.len()];
        let losses = gradient
            .par_chunks_mut(PUBLISHED_WEIGHTS)
            .zip(weights.par_chunks(PUBLISHED_WEIGHTS))
            .zip(&self.targets)
            .map(|((gradient, weights), target)| self.row(weights, target, gradient))
            .collect();
        *self.gradient.lock().map_err(|_| candle_core::Error::Msg("a loss task panicked".into()))? = gradient;
        Ok((CpuStorage::F32(losses), Shape::from(rows)))
    }

    fn bwd(&self, arg: &Tensor, _: &Tensor, by_result: &Tensor) -> Result<Option<Tensor>> {
        let gradient = self.gradient.lock().map_err(|_| candle_core::Error::Msg("a loss task panicked".into()))?;
        let gradient = Tensor::from_slice(&gradient, arg.shape(), arg.device())?;
        Ok(Some(gradient.broadcast_mul(&by_result.unsqueeze(1)?)?))
    }
}

#[cfg(test)]
mod tests {
    use candle_core::{DType, Device, Var};
    use nbrdf_core::nbrdf::fit::{generator, random_network};
    use nbrdf_core::nbrdf::objective::features;
    use nbrdf_core::nbrdf::samples::SampleCounts;

    use super::*;

    /// mean |Δ ln(1 + f c)| of decoded networks in candle's own operations, one row per network.
    fn plain_loss(weights: &Tensor, targets: &[Target]) -> Result<Tensor> {
        let mut rows = Vec::new();
        for (row, target) in targets.iter().enumerate() {
            let samples = &target.samples;
            let count = samples.at.len();
            let inputs = samples
                .at
                .directions()
                .iter()
                .map(|at| at.half_diff())
                .flat_map(|at| [at.half.to_array(), at.diff.to_array()].concat());
            let mut x = Tensor::from_vec(inputs.collect::<Vec<_>>(), (count, 6), &Device::Cpu)?;
            let w = weights.get(row)?;
            let mut start = 0;
            for (layer, (inputs, outputs)) in [(6, 21), (21, 21), (21, 3)].into_iter().enumerate() {
                let kernel = w.narrow(0, start, inputs * outputs)?.reshape((inputs, outputs))?;
                let bias = w.narrow(0, start + inputs * outputs, outputs)?;
                start += inputs * outputs + outputs;
                x = x.matmul(&kernel)?.broadcast_add(&bias)?;
                x = if layer < 2 { x.relu()? } else { (x.exp()? - 1.0)? };
            }
            let cosines = Tensor::from_slice(&samples.factors, (count, 1), &Device::Cpu)?;
            let own = (x.broadcast_mul(&cosines)? + 1.0)?.log()?;
            let Wanted::Features(features) = &target.wanted else { candle_core::bail!("features are compared here") };
            let wanted = Tensor::from_slice(features, (count, 3), &Device::Cpu)?;
            rows.push((own - wanted)?.abs()?.mean_all()?);
        }
        Tensor::stack(&rows, 0)
    }

    #[test]
    fn loss_and_gradient_agree_with_plain_candle_operations() -> Result<()> {
        let networks: Vec<f32> = (0..3).flat_map(|i| random_network(9, i).into_weights()).collect();
        let weights = Var::from_tensor(&Tensor::from_vec(networks, (3, PUBLISHED_WEIGHTS), &Device::Cpu)?)?;
        let counts = SampleCounts { log: 200, relative: 0, pixels: 0, lamps: 0 };
        let target = |i: u64| {
            let samples = Arc::new(Samples::random(&mut generator(i, 5), counts));
            let features = features(&samples, &samples.values(&random_network(10, i)));
            Target { samples, wanted: Wanted::Features(features), weight: 1.0 }
        };
        let targets: Vec<Target> = (0..3).map(target).collect();
        let objective = Objective { log: 1.0, relative: 0.0, display: 0.0, squared: false };
        let fused = decoded_loss(&weights, objective, targets.clone())?;
        let plain = plain_loss(&weights, &targets)?;
        let numbers = |t: &Tensor| t.to_dtype(DType::F32)?.flatten_all()?.to_vec1::<f32>();
        for (a, b) in numbers(&fused)?.into_iter().zip(numbers(&plain)?) {
            assert!((a - b).abs() < 1e-5, "{a} {b}");
        }
        let gradient = |loss: &Tensor| numbers(loss.mean_all()?.backward()?.get(&weights).unwrap());
        let (fused, plain) = (gradient(&fused)?, gradient(&plain)?);
        let largest = plain.iter().fold(0.0f32, |max, g| max.max(g.abs()));
        for (index, (a, b)) in fused.iter().zip(&plain).enumerate() {
            assert!((a - b).abs() < 1e-4 * largest, "weight {index}: {a} {b}");
        }
        Ok(())
    }
}
