//! `nbrdf evaluate`: how close decoded held-out materials come to themselves.

mod text;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use nbrdf_core::cost::REPEATS;
use nbrdf_core::metric::Spread;
use nbrdf_core::{Database, Split};
use serde_json::{Value, json};

use super::{Global, names};
use crate::catalog::{Catalog, REPRESENTATIONS, RepresentationEntry};
use crate::measure::calibration::{Calibration, Judged};
use crate::measure::higher_is_better;
use crate::measure::quality::{Bench, Candidate, Encoded, Quality};
use crate::{progress, report};

/// Measures representations on held-out materials: encode, decode, compare with the reference.
#[derive(Debug, Args)]
pub struct Evaluate {
    /// Representations to measure; all by default.
    #[arg(long = "with", value_name = "NAME", value_parser = names::representations())]
    with: Vec<String>,
    /// Materials to measure against; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Another ZNBRDF checkpoint than the built-in one, or a basis of `nbrdf learn`.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Option<PathBuf>,
    /// Report every material, with its code unless that is longer than 512 numbers.
    #[arg(long)]
    per_material: bool,
    /// Measure the validation materials instead, which PCA bases then have not seen: for choosing among checkpoints
    /// trained with --validate.
    #[arg(long)]
    validate: bool,
}

/// What was said of a material's error, and what is true.
fn judge(encoded: &Encoded) -> Judged {
    let figure = |key: &str| encoded.figures.get(key).copied();
    Judged {
        material: encoded.name.clone(),
        expected: figure("expected_log_error").unwrap_or(f64::NAN),
        distance: figure("distance"),
        truth: figure("log_error").unwrap_or(f64::NAN),
    }
}

impl Evaluate {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let catalog = Catalog::for_measuring(self.reference.as_deref(), self.checkpoint.as_deref())?;
        let catalog = if self.validate { catalog.without_validation()? } else { catalog };
        let reference = catalog.reference();
        for name in &self.with {
            catalog.representation(name, false)?;
        }
        if !self.with.is_empty() {
            catalog.check_used()?;
        }
        let split = if self.validate { Split::Validation } else { Split::HeldOut };
        let chosen = |entry: &&RepresentationEntry| self.with.is_empty() || self.with.iter().any(|n| n == entry.name);
        let entries: Vec<_> = REPRESENTATIONS.iter().filter(chosen).collect();
        let sets: Vec<_> = [Database::Merl, Database::Rgl]
            .into_iter()
            .map(|database| (database, reference.of(database, split)))
            .filter(|(_, materials)| !materials.is_empty())
            .collect();
        if sets.is_empty() {
            let split = if self.validate { "validation" } else { "held-out" };
            return Err(reference.lacks(&format!("{split} materials"), "none"));
        }
        let total: usize = sets.iter().map(|(_, materials)| materials.len()).sum();
        let bar = progress::bar((total * entries.len()) as u64, "evaluating", global.quiet);
        let mut rows = Vec::new();
        let candidate = |entry: &&RepresentationEntry| -> Result<Candidate> {
            Ok(Candidate { representation: entry.build(&catalog)?, known: catalog.autoencoder() })
        };
        let candidates = entries.iter().map(candidate).collect::<Result<Vec<_>>>()?;
        let mut judged: Vec<Vec<Judged>> = entries.iter().map(|_| Vec::new()).collect();
        for (database, materials) in &sets {
            let bench = Bench::new(materials.clone(), global.seed(), REPEATS);
            let qualities = bench.measure(&candidates, &|| bar.inc(1))?;
            for ((entry, quality), judged) in entries.iter().zip(qualities).zip(&mut judged) {
                judged.extend(quality.materials.iter().map(judge));
                rows.push(self.row(entry, *database, &quality));
            }
        }
        bar.finish_and_clear();
        let calibration = entries.iter().zip(&judged);
        let calibration: Vec<Calibration> =
            calibration.map(|(entry, judged)| Calibration::of(entry.name, entry.variant.name(), judged)).collect();
        let rows_text = rows.clone();
        let out = json!({
            "schema": 1, "reference": reference.kind, "split": split, "rows": rows, "calibration": calibration,
            "note": "reference values come from networks, not from measured tables",
        });
        report::print(global, &out, || text::text(&reference.kind, split, &rows_text))
    }

    fn row(&self, entry: &RepresentationEntry, database: Database, quality: &Quality) -> Value {
        let Quality { dim, checkpoint, bytes, shared_bytes, times, materials } = quality;
        let mut row = json!({
            "name": entry.name, "variant": entry.variant.name(), "database": database, "count": materials.len(),
            "dim": dim, "checkpoint": checkpoint, "bytes": bytes, "shared_bytes": shared_bytes,
            "ns": times.map(|times| times.ns), "ratio_to_reference_loop": times.map(|times| times.ratio_to_reference_loop),
        });
        let keys: Vec<&String> = materials.first().map(|first| first.figures.keys().collect()).unwrap_or_default();
        for key in keys {
            let values = materials.iter().map(|m| (m.name.as_str(), m.figures[key]));
            row[key] = json!(Spread::new(values, higher_is_better(key)));
        }
        if self.per_material {
            let material = |m: &Encoded| {
                let mut object = json!(m.figures);
                object["name"] = m.name.as_str().into();
                object["bytes"] = m.bytes.into();
                if let Some(code) = &m.code {
                    object["code"] = json!(code);
                }
                object
            };
            row["materials"] = materials.iter().map(material).collect();
        }
        row
    }
}
