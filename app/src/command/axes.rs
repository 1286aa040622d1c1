//! `nbrdf axes`: whether the axes of `nbrdf edit` do what their names say.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::axis::{Axis, Prior, edit};
use nbrdf_core::metric::Spread;
use nbrdf_core::quality::Qualities;
use nbrdf_core::{Database, Representation, Split};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::Global;
use crate::catalog::Catalog;
use crate::report::table::Table;
use crate::{progress, report};

/// How far every quality is moved, both ways, and in how many steps each way.
const AMOUNT: f64 = 0.12;
const STEPS: i32 = 3;
/// A step back of less than this does not count: it is below what edits aim for.
const TOLERANCE: f64 = 2e-3;

/// Moves every quality of every held-out material, and measures what moves with it.
#[derive(Debug, Args)]
pub struct Axes {
    /// Materials to edit; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Another ZNBRDF checkpoint than the built-in one.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Option<PathBuf>,
}

/// One quality of one material, moved to and fro.
struct Walk {
    material: String,
    /// Whether the quality never went the wrong way.
    monotone: bool,
    /// Change of every quality, in what was asked for of the moved one: of this one, the share that was reached.
    moved: [f64; Axis::ALL.len()],
}

impl Axes {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let catalog = Catalog::for_measuring(self.reference.as_deref(), self.checkpoint.as_deref())?;
        catalog.check_used()?;
        let reference = catalog.reference();
        let known = catalog.autoencoder();
        let prior = known.prior().context("this model remembers no materials to learn axes from")?;
        let representation = catalog.representation(known.name(), false)?;
        let materials = reference.of(Database::Merl, Split::HeldOut);
        if materials.is_empty() {
            return Err(reference.lacks("held-out MERL materials to edit", "none"));
        }
        let codes = materials.iter().map(|m| Ok((m.name.clone(), representation.encode(m)?.code)));
        let codes: Vec<(String, Vec<f32>)> = codes.collect::<Result<_>>()?;
        let bar = progress::bar((codes.len() * Axis::ALL.len()) as u64, "editing", global.quiet);
        let mut rows = Vec::new();
        for axis in Axis::ALL {
            let one = |(name, code): &(String, Vec<f32>)| {
                progress::check()?;
                let walk = walk(known.as_ref(), &prior, name, code, axis)?;
                bar.inc(1);
                Ok(walk)
            };
            rows.push(row(axis, &codes.par_iter().map(one).collect::<Result<Vec<_>>>()?));
        }
        bar.finish_and_clear();
        let out = json!({
            "schema": 1, "reference": reference.kind, "split": Split::HeldOut, "amount": AMOUNT, "axes": rows,
        });
        report::print(global, &out, || text(&rows, codes.len()))
    }
}

fn walk(model: &dyn Representation, prior: &Prior, name: &str, code: &[f32], axis: Axis) -> Result<Walk> {
    let start = Qualities::of(model.decode(&model.code(code.to_vec()))?.as_ref());
    let mut places = Vec::new();
    for direction in [-1.0, 1.0] {
        let mut code = code.to_vec();
        let mut way = Vec::new();
        for _ in 0..STEPS {
            let (next, now) = edit(model, prior, &code, axis, direction * AMOUNT / f64::from(STEPS))?;
            code = next;
            way.push(now);
        }
        if direction < 0.0 {
            way.reverse();
            way.push(start);
        }
        places.extend(way);
    }
    let monotone = places.windows(2).all(|pair| axis.difference(&pair[0], &pair[1]) > -TOLERANCE);
    let (first, last) = (&places[0], &places[places.len() - 1]);
    let moved = Axis::ALL.map(|other| other.difference(first, last) / (2.0 * AMOUNT));
    Ok(Walk { material: name.to_owned(), monotone, moved })
}

fn row(axis: Axis, walks: &[Walk]) -> Value {
    let mean = |i: usize| walks.iter().map(|walk| walk.moved[i].abs()).sum::<f64>() / walks.len().max(1) as f64;
    let moved: Map<String, Value> =
        Axis::ALL.iter().map(|other| (other.name().to_owned(), json!(mean(*other as usize)))).collect();
    json!({
        "axis": axis.name(), "count": walks.len(),
        "monotone": walks.iter().filter(|walk| walk.monotone).count(),
        "reached": Spread::new(walks.iter().map(|walk| (walk.material.as_str(), walk.moved[axis as usize])), true),
        "moved": moved,
    })
}

fn text(rows: &[Value], count: usize) -> String {
    let mut head = vec!["axis".to_owned(), "monotone".to_owned(), "reached".to_owned()];
    head.extend(Axis::ALL.iter().map(|axis| axis.name().to_owned()));
    let mut table = Table::new(head);
    let figure = |value: &Value| report::figure(value.as_f64().unwrap_or(f64::NAN));
    for row in rows {
        let name = row["axis"].as_str().unwrap_or_default();
        let mut cells =
            vec![name.to_owned(), format!("{} of {count}", row["monotone"]), figure(&row["reached"]["mean"])];
        cells.extend(Axis::ALL.iter().map(|axis| figure(&row["moved"][axis.name()])));
        table.push(cells);
    }
    format!(
        "Each quality moved by -{AMOUNT} to +{AMOUNT} on {count} held-out materials: how many moved one way only, the \
         share of the change that was reached, and the mean change of every quality relative to what was asked\n\n{table}"
    )
}
