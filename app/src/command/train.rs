//! `nbrdf train`: the autoencoder, seeded and resumable.

use std::ops::ControlFlow;
use std::path::PathBuf;

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder, DIM, MAX_DIM, Progress, TrainOptions, TrainingData, train};
use clap::{Args, ValueEnum};
use nbrdf_core::library::builtin;
use nbrdf_core::metric::log_error;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Database, Material, Nbrdf, Representation, Split};
use serde_json::json;

use super::Global;
use crate::failure::Failure;
use crate::{families, input, output, progress, report};

/// Analytic materials that training sees beside the measured ones.
const ANALYTIC: usize = 256;
/// Walks between analytic materials that training sees.
const WALKS: usize = 512;
/// Directions of the error shown while training.
const SHOWN: usize = 1024;

/// Trains the autoencoder on a library's training materials.
#[derive(Debug, Args)]
pub struct Train {
    /// Library to learn from; the built-in one by default.
    #[arg(long, value_name = "PATH")]
    library: Option<PathBuf>,
    /// Checkpoint to write (.safetensors).
    #[arg(short, long, value_name = "CKPT")]
    output: PathBuf,
    /// Which autoencoder.
    #[arg(long, value_enum, default_value_t = Kind::Znbrdf)]
    architecture: Kind,
    /// Gradient steps; 48000 for znbrdf, 8000 for the published one.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    steps: Option<u32>,
    /// Numbers in a code, 1 to 128; fewer than 4 carry no colour, and the published architecture has 32.
    #[arg(long, default_value_t = DIM as u16, value_parser = clap::value_parser!(u16).range(1..=MAX_DIM as i64))]
    dim: u16,
    /// Go on from the saved state of an interrupted training.
    #[arg(long)]
    resume: bool,
    /// Set the validation materials aside too, and show the error on them: for making choices.
    #[arg(long)]
    validate: bool,
    /// Train a code that still serves with what codes of 4, 8 and 16 numbers keep of it: an experiment, worse at full length.
    #[arg(long)]
    ordered: bool,
    /// Share of each batch that is analytic materials.
    #[arg(long, value_name = "SHARE")]
    analytic: Option<f32>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    Znbrdf,
    Published,
}

impl Train {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &["safetensors"])?;
        let options = self.options(global)?;
        let loaded = self.library.as_deref().map(input::library).transpose()?;
        let library = loaded.as_ref().unwrap_or_else(|| builtin::shared());
        let shown = if self.validate { Split::Validation } else { Split::HeldOut };
        let learns = |name: &str| Split::of(name).is_learned_from(self.validate);
        let pick = |wanted: &dyn Fn(&str) -> bool| -> Vec<Material> {
            library.materials().into_iter().filter(|material| wanted(&material.name)).collect()
        };
        let measured = pick(&|name| Database::of(name) != Database::Rgl && learns(name));
        let monitored = pick(&|name| Database::of(name) == Database::Merl && Split::of(name) == shown);
        let (networks, start) = self.networks(&measured, &learns);
        let analytic = families::random_materials(global.seed(), ANALYTIC);
        let walks = families::random_walks(global.seed(), WALKS);
        let data = TrainingData { measured: &measured, analytic: &analytic, walks: &walks, networks: &networks, start };
        if self.resume && !autoencoder::state_of(&self.output).exists() {
            if self.output.exists() {
                let found = format!("{} is finished, and there is no state to go on from", self.output.display());
                return Err(Failure::Usage(format!("{found}: leave out --resume to train anew")).into());
            }
            global.warn(format_args!(
                "no saved state at {}: starting anew",
                autoencoder::state_of(&self.output).display()
            ))?;
        }
        if measured.len() < 2 {
            let from =
                self.library.as_ref().map_or("the built-in library".to_owned(), |path| path.display().to_string());
            return Err(Failure::InvalidFile(format!(
                "{from}: expected two or more materials to learn from, found {}: RGL and held-out materials are for testing",
                measured.len()
            ))
            .into());
        }
        let bar = progress::bar(options.steps as u64, "training", global.quiet);
        let mut last = None;
        let trained = train(&data, &options, &self.output, self.resume, &mut |now: Progress, model| {
            let error = if now.step.is_multiple_of(1000) { held_out_error(model, &monitored) } else { None };
            last = error.or(last);
            let error = last.map_or_else(String::new, |error| format!(", held-out log_error {error:.4}"));
            bar.set_position(now.step as u64);
            bar.set_message(format!("loss {:.4}{error}", now.loss));
            if now.step.is_multiple_of(1000) && bar.is_hidden() {
                global.say(format_args!("step {} loss {:.5}{error}", now.step, now.loss));
            }
            if progress::cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        bar.finish_and_clear();
        let summary = json!({
            "schema": 1, "checkpoint": trained.checkpoint(), "model": trained.name(), "options": options,
            "parameters": trained.parameters(), "materials": measured.len(),
            "shown_log_error": held_out_error(&trained, &monitored),
        });
        report::print(global, &summary, || {
            format!("{} {} in {}\n", trained.name(), trained.checkpoint(), self.output.display())
        })
    }

    fn options(&self, global: &Global) -> Result<TrainOptions> {
        let architecture = match self.architecture {
            Kind::Znbrdf => Architecture::Znbrdf,
            Kind::Published => Architecture::Published,
        };
        let mut options = TrainOptions { seed: global.seed(), ..TrainOptions::new(architecture) };
        options.steps = self.steps.map_or(options.steps, |steps| steps as usize);
        options.dim = self.dim.into();
        if options.architecture == Architecture::Published && options.dim != DIM {
            return Err(
                Failure::Usage(format!("the published architecture has codes of {DIM}: leave out --dim")).into()
            );
        }
        if self.ordered && (options.architecture == Architecture::Published || options.dim <= 4) {
            let found = "--ordered is for codes of znbrdf of more than 4 numbers: leave it out";
            return Err(Failure::Usage(found.into()).into());
        }
        options.ordered = self.ordered;
        options.analytic_share = self.analytic.unwrap_or(options.analytic_share);
        if !(0.0..=1.0).contains(&options.analytic_share) {
            return Err(Failure::Usage("--analytic is a share between 0 and 1".into()).into());
        }
        Ok(options)
    }

    /// Ours decodes around the built-in shared start; the published one around the networks it reads.
    fn networks(&self, measured: &[Material], learns: &dyn Fn(&str) -> bool) -> (Vec<Nbrdf>, Option<&'static Nbrdf>) {
        match self.architecture {
            Kind::Published => (measured.iter().filter_map(|material| material.network.clone()).collect(), None),
            Kind::Znbrdf => {
                let shared = builtin::shared();
                let merl = shared.iter().filter(|e| e.database == Database::Merl && learns(&e.name));
                (merl.map(|entry| entry.network.clone()).collect(), shared.shared_start())
            }
        }
    }
}

/// Mean `log_error` over a thinned `rus32k`; for the eye only, nothing is chosen by it.
fn held_out_error(model: &Autoencoder, materials: &[Material]) -> Option<f64> {
    let at: Vec<_> = rus32k().iter().step_by(rus32k().len() / SHOWN).copied().collect();
    let error = |material: &Material| {
        let decoded = model.decode(&model.encode(material).ok()?).ok()?;
        Some(log_error(&at, &evaluate(material.brdf.as_ref(), &at), &evaluate(decoded.as_ref(), &at)))
    };
    let errors: Vec<f64> = materials.iter().filter_map(error).collect();
    (!errors.is_empty()).then(|| errors.iter().sum::<f64>() / errors.len() as f64)
}
