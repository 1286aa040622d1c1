//! `nbrdf sampling`: variance of importance sampling at equal samples, for every material, as a table and a chart.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::metric::Spread;
use nbrdf_core::{Database, Material, Representation, atomic};
use serde_json::{Value, json};

use super::Global;
use crate::catalog::Catalog;
use crate::measure::sampling::{SamplingRow, sampling};
use crate::report::svg::{LogChart, Mark, Series};
use crate::report::table::Table;
use crate::{output, progress, report};

/// Measures importance sampling: relative variance of one sample under white light, for every MERL material.
///
/// Uniform and cosine sampling beside two fitted lobes and the lobe that the autoencoder predicts from the code. N samples
/// have 1/N of the variance, so that ratios are ratios of samples.
#[derive(Debug, Args)]
pub struct Sampling {
    /// Materials to sample; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Another ZNBRDF checkpoint than the built-in one.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Option<PathBuf>,
    /// Chart to write (.svg).
    #[arg(short, long, value_name = "SVG")]
    output: Option<PathBuf>,
}

/// Names and values of the samplers, in the order of the table.
type Column = (&'static str, fn(&SamplingRow) -> f64);
const COLUMNS: [Column; 5] = [
    ("uniform", |row| row.variances.uniform),
    ("cosine", |row| row.variances.cosine),
    ("blinn_phong", |row| row.variances.blinn_phong),
    ("lobe", |row| row.variances.lobe),
    ("predicted_lobe", |row| row.predicted),
];

impl Sampling {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        if let Some(path) = &self.output {
            output::check(path, &["svg"])?;
        }
        let catalog = Catalog::for_measuring(self.reference.as_deref(), self.checkpoint.as_deref())?;
        catalog.check_used()?;
        let reference = catalog.reference();
        let is_merl = |material: &&Material| Database::of(&material.name) == Database::Merl;
        let materials: Vec<&Material> = reference.materials.iter().filter(is_merl).collect();
        if materials.is_empty() {
            return Err(reference.lacks("MERL materials", "none"));
        }
        let bar = progress::bar(materials.len() as u64, "sampling", global.quiet);
        let znbrdf = catalog.autoencoder();
        let encoder = catalog.representation(znbrdf.name(), false)?;
        let mut rows = sampling(&materials, encoder.as_ref(), &znbrdf, &|| bar.inc(1))?;
        bar.finish_and_clear();
        rows.sort_by(|a, b| a.variances.cosine.total_cmp(&b.variances.cosine));
        if let Some(path) = &self.output {
            atomic::write(path, chart(&rows).svg().as_bytes()).with_context(|| path.display().to_string())?;
        }
        let summary = summary(&reference.kind, &rows);
        report::print(global, &summary, || text(&summary))
    }
}

fn summary(reference: &str, rows: &[SamplingRow]) -> Value {
    let spread = |value: fn(&SamplingRow) -> f64, held_out: bool| {
        let chosen = rows.iter().filter(|row| row.held_out || !held_out);
        json!(Spread::new(chosen.map(|row| (row.variances.name.as_str(), value(row))), false))
    };
    let sampler = |(name, value): &Column| {
        let mut row = spread(*value, false);
        row["name"] = (*name).into();
        row["held_out"] = spread(*value, true);
        row
    };
    json!({
        "schema": 1, "reference": reference, "materials": rows.len(),
        "samplers": COLUMNS.iter().map(sampler).collect::<Vec<_>>(), "rows": rows,
    })
}

fn text(summary: &Value) -> String {
    let head = ["sampler", "mean", "median", "p90", "worst", "worst materials", "held out: mean", "worst"];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    for row in summary["samplers"].as_array().into_iter().flatten() {
        let number = |path: &str| report::figure(row.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN));
        let worst: Vec<&str> =
            row["worst"].as_array().into_iter().flatten().take(3).filter_map(Value::as_str).collect();
        let name = row["name"].as_str().unwrap_or_default().to_owned();
        let cells = [number("/mean"), number("/median"), number("/p90"), number("/max"), worst.join(", ")];
        let held_out = [number("/held_out/mean"), number("/held_out/max")];
        table.push(std::iter::once(name).chain(cells).chain(held_out).collect());
    }
    format!(
        "Relative variance of one sample under white light, {} materials, reference: {}\n\n{table}",
        summary["materials"],
        summary["reference"].as_str().unwrap_or_default()
    )
}

/// All materials by rising variance of cosine sampling.
fn chart(rows: &[SamplingRow]) -> LogChart {
    let median = |value: fn(&SamplingRow) -> f64| {
        let values = rows.iter().map(|row| (row.variances.name.as_str(), value(row)));
        Spread::new(values, false).map_or(f64::NAN, |spread| spread.median)
    };
    let series = |index: usize, name: &str, colour, mark, held_out: Option<bool>| {
        let value = COLUMNS[index].1;
        let chosen =
            rows.iter().enumerate().filter(|(_, row)| held_out.is_none_or(|held_out| row.held_out == held_out));
        let point = |(place, row): (usize, &SamplingRow)| {
            (place as f64, value(row), format!("{}: {name} {}", row.variances.name, report::figure(value(row))))
        };
        Series { name: name.to_owned(), colour, mark, points: chosen.map(point).collect() }
    };
    let [cosine, lobe] = [1, 3].map(|index| median(COLUMNS[index].1));
    LogChart {
        title: format!(
            "A fitted lobe of two numbers needs {:.0} times fewer samples than the cosine (medians)",
            cosine / lobe
        ),
        subtitle: format!(
            "{} MERL materials under white light; variance of one sample relative to the squared mean, viewers 0 to 80 degrees",
            rows.len()
        ),
        x_label: "materials, by rising variance of cosine sampling".to_owned(),
        y_label: "relative variance of one sample".to_owned(),
        x_ticks: Vec::new(),
        series: vec![
            series(0, "uniform", 0, Mark::Ring, None),
            series(1, "cosine", 1, Mark::Dot, None),
            series(3, "fitted lobe", 3, Mark::Dot, None),
            series(4, "predicted from the code", 2, Mark::Cross, Some(false)),
            series(4, "the same, held out", 4, Mark::Square, Some(true)),
        ],
    }
}
