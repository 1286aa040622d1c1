//! Training: seeded, resumable with the same bits, written whole or not at all.

mod error;
mod options;
mod state;
mod trainer;

use std::ops::ControlFlow;
use std::path::Path;

use candle_core::{Device, Tensor};
use nbrdf_core::hash::short_hash;

pub use error::TrainError;
pub use options::{TrainOptions, TrainingData, Walk};
pub use state::state_of;
pub use trainer::Trainer;

use crate::checkpoint::{Checkpoint, probe_tensors, save, tensors_of};
use crate::model::Model;
use crate::probe::{PROBES, Probes};
use crate::{Architecture, Autoencoder};
use crate::{known, lobe};

/// Steps between saved states.
const SAVE_EVERY: usize = 1000;
/// Steps between reports of progress.
const REPORT_EVERY: usize = 100;

/// How far training is.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Steps done.
    pub step: usize,
    /// Mean loss since the last report.
    pub loss: f64,
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
    let state = state_of(out);
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
    let walked = data.walks.iter().flat_map(|walk| walk.ends.iter().chain([&walk.between]));
    let values =
        measured.chain(data.analytic).chain(walked).flat_map(|brdf| probes.probe(brdf.as_ref())).flat_map(|f| f.0);
    let networks = data.networks.iter().chain(data.start).flat_map(|network| network.weights().iter().copied());
    short_hash(values.chain(networks))
}

/// Writes the checkpoint: the model, and for ours what goes with it.
fn write(data: &TrainingData, options: &TrainOptions, model: &dyn Model, out: &Path) -> Result<(), TrainError> {
    let mut tensors = tensors_of(model);
    if options.architecture == Architecture::Znbrdf {
        let trained = Autoencoder::of(options.architecture, &Checkpoint::of(model)?)?;
        let codes = known::codes(&trained, data.measured)?;
        tensors.push(known::tensor(&codes)?);
        tensors.extend(lobe::learn(&trained, codes, options.seed)?);
        let (probes, cosines) = probe_tensors();
        tensors.push(("probes".into(), Tensor::from_vec(probes, (PROBES, 6), &Device::Cpu)?));
        tensors.push(("probe_cosine".into(), Tensor::from_vec(cosines, PROBES, &Device::Cpu)?));
    }
    Ok(save(out, &tensors, ("model", options.architecture.name()))?)
}
