//! `nbrdf fit`: a network from measured data.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::library::builtin;
use nbrdf_core::measured::{self, Measured};
use nbrdf_core::metric::{ImageMetric, LogError, Metric, Rendered};
use nbrdf_core::nbrdf::fit::{FitOptions, fit, fit_list, random_hidden};
use nbrdf_core::nbrdf::{MAX_HIDDEN, file};
use nbrdf_core::representation::analytic::{Analytic, GgxLobe, LambertAlone, Parametric};
use nbrdf_core::sample_list::SampleList;
use nbrdf_core::sampling::evaluate;
use nbrdf_core::{Brdf, Material, Nbrdf};
use serde_json::{Value, json};

use super::{Global, warn_of_energy};
use crate::failure::Failure;
use crate::{output, progress, report};

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
}

impl Fit {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &output::NETWORKS)?;
        let measured = Measured::load(&self.source)?;
        if self.leave_out.is_some() && matches!(measured, Measured::Everywhere(_)) {
            return Err(Failure::Usage("--leave-out is for lists of samples: a table is fitted whole".into()).into());
        }
        let start = self.start(global.seed());
        let options = FitOptions { steps: self.steps as usize, ..FitOptions::shared_start(global.seed()) };
        let bar = progress::bar(self.steps.into(), "fitting", global.quiet);
        let cancelled = || {
            bar.inc(64);
            progress::cancelled()
        };
        let (network, error) = match &measured {
            Measured::Everywhere(table) => {
                let network = fit(&start, table.as_ref(), options, &cancelled);
                let network = done(network)?;
                let error = table_error(table.as_ref(), &network);
                (network, error)
            }
            Measured::Somewhere(list) => {
                let (judged, fitted) = match self.leave_out {
                    Some(n) => {
                        let [out, rest] = list.split(n.into(), 0);
                        (out, rest)
                    }
                    None => (list.clone(), list.clone()),
                };
                if fitted.is_empty() {
                    return Err(Failure::Usage("--leave-out leaves no sample to fit to".into()).into());
                }
                let network = done(fit_list(&start, &fitted, options, &cancelled))?;
                let error = json!({
                    "samples": fitted.len(), "judged": judged.len(), "below_horizon": list.below,
                    "mean_relative_error": relative_error(&judged, &network),
                    "of_lambert": formula_error::<LambertAlone>(&fitted, &judged),
                    "of_lambert_ggx": formula_error::<GgxLobe>(&fitted, &judged),
                });
                (network, error)
            }
        };
        bar.finish_and_clear();
        let material = Material::from_network(measured::name_of(&self.source), network.clone());
        warn_of_energy(global, &material)?;
        file::write(&self.output, &network).with_context(|| format!("{}: cannot be written", self.output.display()))?;
        let summary = json!({
            "schema": 1, "material": material.name, "source": self.source.display().to_string(),
            "hidden": network.hidden(), "weights": network.weights().len(), "steps": self.steps, "seed": global.seed(),
            "output": self.output.display().to_string(), "error": error,
        });
        report::print(global, &summary, || text(&summary))
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

fn done(fitted: Option<Nbrdf>) -> Result<Nbrdf> {
    progress::check()?;
    fitted.context("the fit has diverged: are all measured values finite?")
}

fn table_error(table: &dyn Brdf, network: &Nbrdf) -> Value {
    json!({"log_error": LogError.distance(table, network), "studio_psnr": Rendered::studio(ImageMetric::Psnr).distance(table, network)})
}

/// Mean over samples and channels of |found − measured| / measured, those below a thousandth of the mean left out;
/// none where nothing is left.
fn relative_error(list: &SampleList, brdf: &dyn Brdf) -> Option<f64> {
    let found = evaluate(brdf, &list.at);
    let pairs = || list.values.iter().zip(&found).flat_map(|(a, b)| a.0.into_iter().zip(b.0));
    let floor = 1e-3 * pairs().map(|(a, _)| f64::from(a)).sum::<f64>() / (3 * list.len()) as f64;
    let (sum, count) = pairs()
        .filter(|(a, _)| f64::from(*a) > floor)
        .fold((0.0, 0_usize), |(sum, count), (a, b)| (sum + f64::from((b - a).abs() / a), count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// The same of a formula fitted to the same samples.
fn formula_error<P: Parametric>(fitted: &SampleList, judged: &SampleList) -> Option<f64> {
    Analytic::<P>::fit_list(fitted).and_then(|brdf| relative_error(judged, brdf.as_ref()))
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
