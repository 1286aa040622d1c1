//! Training: seeded, resumable with the same bits, written whole or not at all.

mod state;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use candle_core::{Device, Tensor};
use nbrdf_core::hash::short_hash;
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::nbrdf::objective::Objective;
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};
use nbrdf_core::{Brdf, Material, Nbrdf};

use crate::checkpoint::{Checkpoint, CheckpointError, probe_tensors, save, tensors_of};
use crate::dataset::{BATCH, Batch, Batches, Pool, Spheres};
use crate::loss::decoded_loss;
use crate::model::{FEATURES, Model, PublishedModel, ZnbrdfModel};
use crate::optimizer::AdamW;
use crate::probe::{PROBES, Probes};
use crate::{Architecture, Autoencoder};

/// Steps during which the learning rate rises.
const WARM_UP: usize = 300;
/// Steps between saved states.
const SAVE_EVERY: usize = 1000;
/// Steps between reports of progress.
const REPORT_EVERY: usize = 100;

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

/// How far training is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Steps done.
    pub step: usize,
    /// Mean loss since the last report.
    pub loss: f64,
}

/// Why training ended without a checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum TrainError {
    /// Stopped on request; the state is saved.
    #[error("stopped at step {step}; go on with --resume (state in {})", state.display())]
    Stopped {
        /// Steps done.
        step: usize,
        /// Where the state is.
        state: PathBuf,
    },
    /// The loss is NaN or infinite.
    #[error("the loss is {loss} at step {step}: are all training materials finite?")]
    Diverged {
        /// Steps done.
        step: usize,
        /// The loss.
        loss: f64,
    },
    /// Too little to learn from.
    #[error("training needs at least two materials with networks of the published shape, found {found}")]
    TooFew {
        /// Materials found.
        found: usize,
    },
    /// A state was saved with other options or data.
    #[error("{path}: saved by a training with other options: {found}; expected {expected}")]
    OtherRun {
        /// The state.
        path: String,
        /// Options asked for.
        expected: String,
        /// Options in the state.
        found: String,
    },
    /// A file could not be read or written.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The tensor library failed (a bug, or out of memory).
    #[error("tensor library: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// Trains and writes the checkpoint to `out`; `resume` goes on from a saved state if there is one.
///
/// Same options, data and seed give the same bits, also through an interruption.
pub fn train(
    data: &TrainingData,
    options: &TrainOptions,
    out: &Path,
    resume: bool,
    progress: &mut dyn FnMut(Progress, &Autoencoder) -> ControlFlow<()>,
) -> Result<Autoencoder, TrainError> {
    let Prepared { model, batches, objective } = prepare(data, options)?;
    let model = model.as_ref();
    let mut optimizer = AdamW::new(model.parameters());
    let fingerprint = fingerprint(data);
    let run = state::Run { options, data: &fingerprint };
    let state = state::path(out);
    if resume && state.exists() {
        state::load(&state, run, model, &mut optimizer)?;
    }
    let mut loss_sum = 0.0;
    while optimizer.step < options.steps {
        let step = optimizer.step;
        let loss = one_step(model, &mut optimizer, batches.batch(options.seed, step), objective, rate(options, step))?;
        if !loss.is_finite() {
            return Err(TrainError::Diverged { step, loss });
        }
        loss_sum += loss;
        let done = optimizer.step;
        let mut stop = false;
        if done.is_multiple_of(REPORT_EVERY) {
            let report = Progress { step: done, loss: loss_sum / REPORT_EVERY as f64 };
            loss_sum = 0.0;
            let now = Autoencoder::of(options.architecture, &Checkpoint::of(model)?)?;
            stop = progress(report, &now).is_break();
        }
        if stop || done.is_multiple_of(SAVE_EVERY) {
            state::save(&state, run, model, &optimizer)?;
        }
        if stop && done < options.steps {
            return Err(TrainError::Stopped { step: done, state });
        }
    }
    write(options.architecture, model, out)?;
    // Only a finished checkpoint makes the state superfluous; a state that cannot be removed does no harm.
    let _ = std::fs::remove_file(&state);
    Ok(Autoencoder::load(out)?)
}

/// Hash of what is learned from: every material's values at the probes, and the networks.
fn fingerprint(data: &TrainingData) -> String {
    let probes = Probes::new();
    let measured = data.measured.iter().map(|material| &material.brdf);
    let values = measured.chain(data.analytic).flat_map(|brdf| probes.probe(brdf.as_ref())).flat_map(|f| f.0);
    let networks = data.networks.iter().chain(data.start).flat_map(|network| network.weights().iter().copied());
    short_hash(values.chain(networks))
}

/// What is trained, on what, towards what.
struct Prepared {
    model: Box<dyn Model>,
    batches: Box<dyn Batches>,
    objective: Objective,
}

fn prepare(data: &TrainingData, options: &TrainOptions) -> Result<Prepared, TrainError> {
    let networks: Vec<&Nbrdf> = data.networks.iter().filter(|n| n.hidden() == PUBLISHED_HIDDEN).collect();
    if networks.len() < 2 || data.measured.len() < 2 {
        return Err(TrainError::TooFew { found: networks.len().min(data.measured.len()) });
    }
    let mean = mean(&networks);
    let rng = &mut generator(options.seed, 0);
    let (model, batches, objective): (Box<dyn Model>, Box<dyn Batches>, Objective) = match options.architecture {
        Architecture::Znbrdf => {
            let start = data.start.map_or(mean.as_slice(), Nbrdf::weights);
            let model = ZnbrdfModel::new(start, &spread(&networks, start), rng)?;
            let pool = Pool::new(data.measured, data.analytic, options.analytic_share, options.seed);
            (Box::new(model), Box::new(pool), Objective::FIT)
        }
        Architecture::Published => {
            let model = PublishedModel::new(&mean, &spread(&networks, &mean), rng)?;
            let networks: Vec<Nbrdf> = networks.into_iter().cloned().collect();
            (Box::new(model), Box::new(Spheres::new(&networks)), Objective::IMAGE)
        }
    };
    Ok(Prepared { model, batches, objective })
}

fn one_step(
    model: &dyn Model,
    optimizer: &mut AdamW,
    batch: Batch,
    objective: Objective,
    rate: f64,
) -> Result<f64, candle_core::Error> {
    let columns = batch.input.len() / BATCH;
    let input = match columns == 3 * FEATURES {
        true => Tensor::from_vec(batch.input, (BATCH, 3, FEATURES), &Device::Cpu)?,
        false => Tensor::from_vec(batch.input, (BATCH, columns), &Device::Cpu)?,
    };
    let weights = model.decode(&model.encode(&input)?)?;
    let loss = decoded_loss(&weights, objective, batch.targets)?.mean_all()?;
    // The layers leave their gradients with the parameters.
    loss.backward()?;
    optimizer.step(model.parameters(), rate)?;
    Ok(f64::from(loss.to_scalar::<f32>()?))
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

fn write(architecture: Architecture, model: &dyn Model, out: &Path) -> Result<(), TrainError> {
    let mut tensors = tensors_of(model);
    if architecture == Architecture::Znbrdf {
        let (probes, cosines) = probe_tensors();
        tensors.push(("probes".into(), Tensor::from_vec(probes, (PROBES, 6), &Device::Cpu)?));
        tensors.push(("probe_cosine".into(), Tensor::from_vec(cosines, PROBES, &Device::Cpu)?));
    }
    Ok(save(out, &tensors, ("model", architecture.name()))?)
}
