//! Training: seeded, resumable with the same bits, written whole or not at all.

mod state;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use candle_core::{Device, Tensor};
use nbrdf_core::hash::short_hash;
use nbrdf_core::{Brdf, Material, Nbrdf};

use crate::checkpoint::{Checkpoint, CheckpointError, probe_tensors, save, tensors_of};
use crate::lobe;
use crate::model::Model;
use crate::probe::{PROBES, Probes};
use crate::trainer::Trainer;
use crate::{Architecture, Autoencoder};

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
    let mut trainer = Trainer::new(data, options)?;
    let fingerprint = fingerprint(data);
    let run = state::Run { options, data: &fingerprint };
    let state = state::path(out);
    if resume && state.exists() {
        state::load(&state, run, trainer.model.as_ref(), &mut trainer.optimizer)?;
    }
    let mut loss_sum = 0.0;
    while trainer.done() < options.steps {
        loss_sum += trainer.step()?;
        let done = trainer.done();
        let mut stop = false;
        if done.is_multiple_of(REPORT_EVERY) {
            let report = Progress { step: done, loss: loss_sum / REPORT_EVERY as f64 };
            loss_sum = 0.0;
            let now = Autoencoder::of(options.architecture, &Checkpoint::of(trainer.model.as_ref())?)?;
            stop = progress(report, &now).is_break();
        }
        if stop || done.is_multiple_of(SAVE_EVERY) {
            state::save(&state, run, trainer.model.as_ref(), &trainer.optimizer)?;
        }
        if stop && done < options.steps {
            return Err(TrainError::Stopped { step: done, state });
        }
    }
    write(data, options, trainer.model.as_ref(), out)?;
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

/// Writes the checkpoint: the model, and for ours what goes with it.
fn write(data: &TrainingData, options: &TrainOptions, model: &dyn Model, out: &Path) -> Result<(), TrainError> {
    let mut tensors = tensors_of(model);
    if options.architecture == Architecture::Znbrdf {
        let trained = Autoencoder::of(options.architecture, &Checkpoint::of(model)?)?;
        tensors.extend(lobe::learn(&trained, data.measured, options.seed)?);
        let (probes, cosines) = probe_tensors();
        tensors.push(("probes".into(), Tensor::from_vec(probes, (PROBES, 6), &Device::Cpu)?));
        tensors.push(("probe_cosine".into(), Tensor::from_vec(cosines, PROBES, &Device::Cpu)?));
    }
    Ok(save(out, &tensors, ("model", options.architecture.name()))?)
}
