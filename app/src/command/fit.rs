//! `nbrdf fit`: a network from measured data.

pub(crate) mod judge;
mod refused;
mod text;

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::Warning;
use nbrdf_core::measured::{self, Measured};
use nbrdf_core::nbrdf::MAX_HIDDEN;
use nbrdf_core::nbrdf::fit::FitOptions;
use nbrdf_core::sample_list::SampleList;
use serde_json::json;

use super::Global;
use crate::fitted::{self, Fitted};
use crate::measure::guard;
use crate::{output, progress, report};
use judge::{samples_error, table_error};

/// Fits a network to a measurement: MERL .binary, RGL .bsdf, goniometer text .brdf, or values in .csv.
#[derive(Debug, Args)]
pub struct Fit {
    /// The measurement.
    #[arg(value_name = "SRC")]
    source: PathBuf,
    /// File of the network: .npz, .safetensors, or .npy for a set of six.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Steps of the fit.
    #[arg(long, default_value_t = 30_000, value_parser = clap::value_parser!(u32).range(1..))]
    steps: u32,
    /// Widths of the two hidden layers.
    #[arg(long, value_name = "WIDTH,WIDTH", default_value = "21,21", value_parser = widths)]
    hidden: [usize; 2],
    /// Judge by samples that were left out: N more fits to a list, each without every N-th sample. What is written has
    /// seen all.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(2..=50))]
    leave_out: Option<u8>,
    /// Let the network read how light and view are turned about the normal, for brushed metals and fabrics. RGL files say
    /// themselves whether it matters. Such a network is a .safetensors; it is rendered, and has no code.
    #[arg(long)]
    anisotropic: bool,
}

impl Fit {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &output::NETWORKS)?;
        self.check_source()?;
        let measured = Measured::load(&self.source)?;
        let turns = self.anisotropic || matches!(measured, Measured::Turning(_));
        if turns {
            output::check(&self.output, &["safetensors"])?;
        }
        self.check(&measured)?;
        let start = fitted::start(global.seed(), self.hidden);
        let options = FitOptions { steps: self.steps as usize, ..FitOptions::shared_start(global.seed()) };
        let source: Vec<Warning> = match &measured {
            Measured::Everywhere(table) | Measured::Turning(table) => guard::of_source(table.as_ref()).collect(),
            Measured::Somewhere(list) => guard::of_samples(list.len(), start.weights().len()).into_iter().collect(),
        };
        global.warn_of(&measured::name_of(&self.source), source)?;
        let fits = 1 + u64::from(self.leave_out.unwrap_or(0));
        let bar = progress::bar(fits * u64::from(self.steps), "fitting", global.quiet);
        let cancelled = || {
            bar.inc(64);
            progress::cancelled()
        };
        let fitted = finished(Fitted::to(&measured, turns, &start, options, &cancelled))?;
        let material = measured::name_of(&self.source);
        global.warn_of(
            &material,
            guard::of_energy(fitted.albedo_max()).into_iter().chain(guard::of_use(fitted.brdf())),
        )?;
        // Before it is judged by more fits: what is done is not lost with them.
        fitted.write(&self.output)?;
        let error = match &measured {
            Measured::Everywhere(table) | Measured::Turning(table) => table_error(table.as_ref(), fitted.brdf(), turns),
            Measured::Somewhere(list) => {
                let refit = |rest: &SampleList| finished(Fitted::to_list(rest, turns, &start, options, &cancelled));
                samples_error(list, self.leave_out.map(usize::from), fitted.brdf(), &refit)?
            }
        };
        bar.finish_and_clear();
        let summary = json!({
            "schema": 1, "material": material, "source": self.source.display().to_string(),
            "hidden": fitted.hidden(), "weights": fitted.weights().len(), "anisotropic": turns,
            "steps": self.steps, "seed": global.seed(),
            "output": self.output.display().to_string(), "error": error,
        });
        report::print(global, &summary, || text::text(&summary))
    }
}

/// The fit, or why there is none.
fn finished(fitted: Option<Fitted>) -> Result<Fitted> {
    progress::check()?;
    fitted.context(fitted::DIVERGED)
}

/// Two widths, as in 21,21.
fn widths(text: &str) -> Result<[usize; 2], String> {
    let mut widths = text.split(',').map(|width| width.trim().parse::<usize>().ok());
    match [widths.next(), widths.next(), widths.next()] {
        [Some(Some(first)), Some(Some(second)), None]
            if [first, second].iter().all(|width| (1..=MAX_HIDDEN).contains(width)) =>
        {
            Ok([first, second])
        }
        _ => Err(format!("expected two widths of 1 to {MAX_HIDDEN}, as in 21,21")),
    }
}
