//! From the numbers of a code to the two of a lobe to sample from: 32 → 8 → 2 where codes have 32.
//!
//! Sztrajman et al. (2021), section on importance sampling. Differs from the paper: the lobe is GGX's visible normals over
//! a cosine base, and the network learns where the variance is least ([`Valley`]), not the parameters of a fit.

use candle_core::{Device, Tensor};
use nbrdf_core::nbrdf::fit::{cosine, generator};
use nbrdf_core::sampler::curvature::Valley;
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::{Brdf, Representation};
use rand::RngExt;
use rayon::prelude::*;

use crate::Autoencoder;
use crate::activation::Activation;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::inference::Chain;
use crate::model::{add_chain, chain};
use crate::optimizer::AdamW;
use crate::parameters::Parameters;

/// Mixes of two training codes that are learned from beside the training materials.
const MIXES: usize = 400;
const STEPS: usize = 3000;
const RATE: f32 = 1e-2;
/// Cost beyond which a miss counts linearly: one material that no lobe serves does not decide for all.
const LARGE: f64 = 0.5;

/// Widths of the layers.
const fn widths(dim: usize) -> [usize; 3] {
    [dim, 8, 2]
}

/// The small network.
pub(crate) struct LobeNetwork {
    layers: Chain,
    /// Mean and spread of the training codes.
    mean: Vec<f32>,
    spread: Vec<f32>,
}

impl LobeNetwork {
    /// From the tensors of a checkpoint whose codes have `dim` numbers.
    pub fn new(file: &Checkpoint, dim: usize) -> Result<Self, CheckpointError> {
        Ok(Self {
            layers: Chain::new(file, "lobe", &widths(dim), Activation::Silu)?,
            mean: file.tensor("lobe.mean", &[dim])?.to_vec(),
            spread: file.tensor("lobe.spread", &[dim])?.to_vec(),
        })
    }

    /// The lobe of a code \[dim\].
    pub fn predict(&self, code: &[f32]) -> Lobe {
        let standard = standardized(code, &self.mean, &self.spread);
        let mut out = [0.0; 2];
        self.layers.apply(&standard, &mut out);
        Lobe::from_coordinates(out.map(f64::from))
    }
}

fn standardized(code: &[f32], mean: &[f32], spread: &[f32]) -> Vec<f32> {
    code.iter().zip(mean.iter().zip(spread)).map(|(v, (mean, spread))| (v - mean) / spread).collect()
}

/// Learns lobes of the codes of training materials and of mixes of two; the tensors for the checkpoint.
///
/// Same autoencoder, codes and seed, same bits.
pub(crate) fn learn(
    autoencoder: &Autoencoder,
    codes: Vec<Vec<f32>>,
    seed: u64,
) -> candle_core::Result<Vec<(String, Tensor)>> {
    let examples = examples(autoencoder, codes, seed);
    if examples.is_empty() {
        candle_core::bail!("no material to learn lobes from");
    }
    let dim = autoencoder.dim();
    let (mean, spread) = moments(&examples, dim);
    let input: Vec<f32> = examples.iter().flat_map(|(code, _)| standardized(code, &mean, &spread)).collect();
    let column = |value: &dyn Fn(&Valley) -> f64| {
        let values: Vec<f32> = examples.iter().map(|(_, valley)| value(valley) as f32).collect();
        Tensor::from_vec(values, examples.len(), &Device::Cpu)
    };
    let lowest = [column(&|v| v.lowest[0])?, column(&|v| v.lowest[1])?];
    let curvature = [column(&|v| v.curvature[0])?, column(&|v| v.curvature[1])?, column(&|v| v.curvature[2])?];
    let input = Tensor::from_vec(input, (examples.len(), dim), &Device::Cpu)?;
    let mut parameters = Parameters::new();
    add_chain(&mut parameters, "lobe", &widths(dim), 1.0, &mut generator(seed, 20))?;
    let mut optimizer = AdamW::new(&parameters);
    for step in 0..STEPS {
        let found = chain(&parameters, "lobe", 2, &input, Activation::Silu, None)?;
        let [a, b] = [0, 1].map(|i| found.narrow(1, i, 1)?.squeeze(1)?.sub(&lowest[i]));
        let (a, b) = (a?, b?);
        let [aa, ab, bb] = &curvature;
        let cost = (((a.sqr()? * aa)? + (b.sqr()? * bb)?)? * 0.5)?.add(&((&a * &b)? * ab)?)?;
        // √(1 + c/l) − 1 grows like c/2l, then like a root; never quite flat, so that widths without a cost stay in range.
        let cost = (((cost / LARGE)? + (((a.sqr()? + b.sqr()?)? * 1e-4)? + 1.0)?)?.sqrt()?).mean_all()?;
        cost.backward()?;
        optimizer.step(&parameters, f64::from(cosine(RATE, step, STEPS)))?;
    }
    let mut tensors: Vec<(String, Tensor)> =
        parameters.iter().map(|own| (own.name.clone(), own.var.as_tensor().clone())).collect();
    tensors.push(("lobe.mean".to_owned(), Tensor::from_vec(mean, dim, &Device::Cpu)?));
    tensors.push(("lobe.spread".to_owned(), Tensor::from_vec(spread, dim, &Device::Cpu)?));
    Ok(tensors)
}

/// Codes and what lobes cost for them. Materials are taken as the code decodes to: that is what will be sampled.
fn examples(autoencoder: &Autoencoder, codes: Vec<Vec<f32>>, seed: u64) -> Vec<(Vec<f32>, Valley)> {
    let mut rng = generator(seed, 21);
    let mut all = codes.clone();
    for _ in 0..if codes.len() < 2 { 0 } else { MIXES } {
        let [a, b] = std::array::from_fn(|_| &codes[rng.random_range(0..codes.len())]);
        let t: f32 = rng.random_range(0.0..1.0);
        all.push(a.iter().zip(b).map(|(a, b)| a + t * (b - a)).collect());
    }
    let valley = |code: Vec<f32>| {
        let decoded: Box<dyn Brdf> = autoencoder.decode(&autoencoder.code(code.clone())).ok()?;
        Some((code, Valley::of(decoded.as_ref())?))
    };
    all.into_par_iter().filter_map(valley).collect()
}

/// Mean and spread of every number, the spread never quite zero.
fn moments(examples: &[(Vec<f32>, Valley)], dim: usize) -> (Vec<f32>, Vec<f32>) {
    let count = examples.len() as f64;
    let numbers = |i: usize| examples.iter().map(move |(code, _)| f64::from(code[i]));
    let mean: Vec<f64> = (0..dim).map(|i| numbers(i).sum::<f64>() / count).collect();
    let spread = (0..dim).map(|i| (numbers(i).map(|v| (v - mean[i]).powi(2)).sum::<f64>() / count).sqrt().max(1e-3));
    let spread = spread.map(|v| v as f32).collect();
    (mean.into_iter().map(|v| v as f32).collect(), spread)
}
