//! `nbrdf fit`: a network from measured data.

mod fitted;
mod judge;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use nbrdf_core::Nbrdf;
use nbrdf_core::library::builtin;
use nbrdf_core::measured::{self, Measured};
use nbrdf_core::nbrdf::MAX_HIDDEN;
use nbrdf_core::nbrdf::fit::{FitOptions, random_hidden};
use nbrdf_core::sample_list::SampleList;
use serde_json::{Value, json};

use super::Global;
use crate::failure::Failure;
use crate::{output, progress, report};
use fitted::Fitted;
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
    /// Leave out every N-th sample of a list, and judge by these.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..))]
    leave_out: Option<u16>,
    /// Let the network read how light and view are turned about the normal, for brushed metals and fabrics. RGL files say
    /// themselves whether it matters. Such a network is a .safetensors; it is rendered, and has no code.
    #[arg(long)]
    anisotropic: bool,
}

impl Fit {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &output::NETWORKS)?;
        let measured = Measured::load(&self.source)?;
        let turns = self.anisotropic || matches!(measured, Measured::Turning(_));
        if turns {
            output::check(&self.output, &["safetensors"])?;
        }
        let (measured, judged) = self.leave_out(measured)?;
        let start = self.start(global.seed());
        let options = FitOptions { steps: self.steps as usize, ..FitOptions::shared_start(global.seed()) };
        let bar = progress::bar(self.steps.into(), "fitting", global.quiet);
        let cancelled = || {
            bar.inc(64);
            progress::cancelled()
        };
        let fitted = Fitted::to(&measured, turns, &start, options, &cancelled)?;
        let error = match &measured {
            Measured::Everywhere(table) | Measured::Turning(table) => table_error(table.as_ref(), fitted.brdf(), turns),
            Measured::Somewhere(list) => samples_error(list, judged.as_ref().unwrap_or(list), fitted.brdf()),
        };
        bar.finish_and_clear();
        let material = measured::name_of(&self.source);
        global.check_energy(&material, fitted.albedo_max())?;
        fitted.write(&self.output)?;
        let summary = json!({
            "schema": 1, "material": material, "source": self.source.display().to_string(),
            "hidden": fitted.hidden(), "weights": fitted.weights().len(), "anisotropic": turns,
            "steps": self.steps, "seed": global.seed(),
            "output": self.output.display().to_string(), "error": error,
        });
        report::print(global, &summary, || text(&summary))
    }

    /// What is fitted to, and the samples that are left out of it.
    fn leave_out(&self, measured: Measured) -> Result<(Measured, Option<SampleList>)> {
        match (measured, self.leave_out) {
            (measured, None) => Ok((measured, None)),
            (Measured::Somewhere(list), Some(n)) => {
                let [out, rest] = list.split(n.into(), 0);
                if rest.is_empty() {
                    return Err(Failure::Usage("--leave-out leaves no sample to fit to".into()).into());
                }
                Ok((Measured::Somewhere(rest), Some(out)))
            }
            (Measured::Everywhere(_) | Measured::Turning(_), Some(_)) => {
                Err(Failure::Usage("--leave-out is for lists of samples: a table is fitted whole".into()).into())
            }
        }
    }

    /// The shared start of the built-in library, or random weights where widths differ.
    fn start(&self, seed: u64) -> Nbrdf {
        match builtin::shared().shared_start() {
            Some(start) if start.hidden() == self.hidden => start.clone(),
            _ => random_hidden(seed, 0, self.hidden),
        }
    }
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

fn text(summary: &Value) -> String {
    let figures = summary["error"].as_object().into_iter().flatten();
    let figure = |(key, value): (&String, &Value)| format!("  {key:22}{value}\n");
    let lines: String = figures.map(figure).collect();
    format!(
        "{} in {}\n{lines}",
        summary["material"].as_str().unwrap_or_default(),
        summary["output"].as_str().unwrap_or_default()
    )
}
