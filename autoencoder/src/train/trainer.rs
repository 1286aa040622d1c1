//! One step of training after the other.

use candle_core::{Device, Tensor};
use nbrdf_core::Nbrdf;
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::nbrdf::objective::Objective;
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};
use rand::RngExt;

use super::{TrainError, TrainOptions, TrainingData};
use crate::Architecture;
use crate::dataset::{BATCH, Batches, Pool, Spheres};
use crate::loss::decoded_loss;
use crate::model::{CodeLayout, FEATURES, Model, PublishedModel, ZnbrdfModel};
use crate::optimizer::AdamW;

/// Steps during which the learning rate rises.
const WARM_UP: usize = 300;
/// Lengths at which an ordered code should serve, beside its whole length.
const PREFIXES: [usize; 4] = [4, 8, 16, 32];

/// A training under way: what is trained, on what, towards what. [`train`](crate::train()) drives it and keeps its state.
pub struct Trainer {
    pub(crate) model: Box<dyn Model>,
    pub(crate) optimizer: AdamW,
    batches: Box<dyn Batches>,
    objective: Objective,
    options: TrainOptions,
}

impl Trainer {
    /// At the start.
    ///
    /// # Errors
    /// [`TrainError::TooFew`] if there is too little to learn from.
    pub fn new(data: &TrainingData, options: &TrainOptions) -> Result<Self, TrainError> {
        let networks: Vec<&Nbrdf> = data.networks.iter().filter(|n| n.hidden() == PUBLISHED_HIDDEN).collect();
        if networks.len() < 2 || data.measured.len() < 2 {
            return Err(TrainError::TooFew { found: networks.len().min(data.measured.len()) });
        }
        let mean = mean(&networks);
        let rng = &mut generator(options.seed, 0);
        let (model, batches, objective): (Box<dyn Model>, Box<dyn Batches>, Objective) = match options.architecture {
            Architecture::Znbrdf => {
                let start = data.start.map_or(mean.as_slice(), Nbrdf::weights);
                let model = ZnbrdfModel::new(CodeLayout::new(options.dim), start, &spread(&networks, start), rng)?;
                let pool = Pool::new(data, options.analytic_share, options.seed);
                (Box::new(model), Box::new(pool), Objective::TRAIN)
            }
            Architecture::Published => {
                let model = PublishedModel::new(&mean, &spread(&networks, &mean), rng)?;
                let networks: Vec<Nbrdf> = networks.into_iter().cloned().collect();
                (Box::new(model), Box::new(Spheres::new(&networks)), Objective::IMAGE)
            }
        };
        let optimizer = AdamW::new(model.parameters());
        Ok(Self { model, optimizer, batches, objective, options: options.clone() })
    }

    /// Steps done.
    pub const fn done(&self) -> usize {
        self.optimizer.step
    }

    /// One step; the loss before it.
    ///
    /// # Errors
    /// [`TrainError::Diverged`] if the loss is not finite.
    pub fn step(&mut self) -> Result<f64, TrainError> {
        let step = self.done();
        let batch = self.batches.batch(self.options.seed, step);
        let walks = batch.places.len();
        let rows = BATCH + 2 * walks;
        let columns = batch.input.len() / rows;
        let input = match columns == 3 * FEATURES {
            true => Tensor::from_vec(batch.input, (rows, 3, FEATURES), &Device::Cpu)?,
            false => Tensor::from_vec(batch.input, (rows, columns), &Device::Cpu)?,
        };
        let codes = self.model.encode(&input)?;
        let codes = if walks > 0 { with_mixed(&codes, batch.places)? } else { codes };
        let codes = if self.is_ordered() { (codes * self.prefixes(step, BATCH + walks)?)? } else { codes };
        let weights = self.model.decode(&codes)?;
        let mean = (decoded_loss(&weights, self.objective, batch.targets)?.sum_all()? / BATCH as f64)?;
        let loss = f64::from(mean.to_scalar::<f32>()?);
        if !loss.is_finite() {
            return Err(TrainError::Diverged { step, loss });
        }
        // The layers leave their gradients with the parameters.
        mean.backward()?;
        self.optimizer.step(self.model.parameters(), rate(&self.options, step))?;
        Ok(loss)
    }

    /// The published architecture's numbers have no order.
    fn is_ordered(&self) -> bool {
        self.options.ordered && self.options.architecture == Architecture::Znbrdf
    }

    /// What is left of every row's code, 1 or 0 \[rows, dim\].
    fn prefixes(&self, step: usize, rows: usize) -> Result<Tensor, TrainError> {
        let dim = self.options.dim;
        let lengths: Vec<usize> = PREFIXES.into_iter().filter(|length| *length < dim).chain([dim]).collect();
        let rng = &mut generator(self.options.seed, (1 << 42) + step as u64);
        let row = |_| CodeLayout::new(dim).prefix(lengths[rng.random_range(0..lengths.len())]);
        let kept: Vec<f32> = (0..rows).flat_map(row).collect();
        Ok(Tensor::from_vec(kept, (rows, dim), &Device::Cpu)?)
    }
}

/// The materials' codes, then the mixed codes of the walks between the codes that follow.
fn with_mixed(codes: &Tensor, places: Vec<f32>) -> Result<Tensor, TrainError> {
    let walks = places.len();
    let [starts, ends] = [BATCH, BATCH + walks].map(|from| codes.narrow(0, from, walks));
    let (starts, place) = (starts?, Tensor::from_vec(places, (walks, 1), &Device::Cpu)?);
    let mixed = (&starts + (ends? - &starts)?.broadcast_mul(&place)?)?;
    Ok(Tensor::cat(&[&codes.narrow(0, 0, BATCH)?, &mixed], 0)?)
}

/// Learning rate: a linear rise, then half a cosine down to zero.
fn rate(options: &TrainOptions, step: usize) -> f64 {
    let rise = ((step + 1) as f64 / WARM_UP as f64).min(1.0);
    let fall = 0.5 * (1.0 + (std::f64::consts::PI * step as f64 / options.steps as f64).cos());
    options.rate * rise * fall
}

fn mean(networks: &[&Nbrdf]) -> Vec<f32> {
    let at = |i: usize| networks.iter().map(|n| f64::from(n.weights()[i])).sum::<f64>() / networks.len() as f64;
    (0..PUBLISHED_WEIGHTS).map(|i| at(i) as f32).collect()
}

/// Root mean square distance of every weight from `centre`, never quite zero.
fn spread(networks: &[&Nbrdf], centre: &[f32]) -> Vec<f32> {
    let square = |i: usize| networks.iter().map(|n| f64::from(n.weights()[i] - centre[i]).powi(2)).sum::<f64>();
    (0..PUBLISHED_WEIGHTS).map(|i| (square(i) / networks.len() as f64).sqrt().max(1e-2) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixed_codes_follow_the_materials_and_lie_where_the_walk_says() {
        // Number i of every code is 10 i + row.
        let rows = BATCH + 4;
        let codes: Vec<f32> = (0..rows).flat_map(|row| [row as f32, 10.0 + row as f32]).collect();
        let codes = Tensor::from_vec(codes, (rows, 2), &Device::Cpu).unwrap();
        let mixed = with_mixed(&codes, vec![0.25, 1.0]).unwrap().to_vec2::<f32>().unwrap();
        assert_eq!(mixed.len(), BATCH + 2);
        assert_eq!(mixed[3], [3.0, 13.0]);
        let from = BATCH as f32;
        assert_eq!(mixed[BATCH], [from + 0.5, from + 10.5]);
        assert_eq!(mixed[BATCH + 1], [from + 3.0, from + 13.0]);
    }
}
