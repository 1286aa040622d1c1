//! `nbrdf reconstruct`: how few measurements tell a material, as tables and a chart.

mod chart;

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::representation::optimal_sampling::log_relative::SeenComponents;
use nbrdf_core::sampling::rus32k;
use nbrdf_core::{Database, Split, atomic};
use serde_json::json;

use super::Global;
use crate::catalog::Catalog;
use crate::measure::reconstruction::combination::{self, CombinationRow, combination};
use crate::measure::reconstruction::directions::{self, DirectionsRow, directions};
use crate::measure::reconstruction::images::{self, ImagesRow, images};
use crate::measure::reconstruction::{Draws, Targets};
use crate::report::figure;
use crate::report::table::Table;
use crate::{output, progress, report};

/// Measures reconstruction from few samples on held-out MERL materials: measured materials as a basis, a few chosen
/// directions, pictures of a sphere.
#[derive(Debug, Args)]
pub struct Reconstruct {
    /// Materials to learn from and to measure; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Random draws of samples, 1 to 1000.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=1000))]
    draws: u64,
    /// Measure the validation materials instead, with bases that have not seen them.
    #[arg(long)]
    validate: bool,
    /// Chart to write (.svg).
    #[arg(short, long, value_name = "SVG")]
    output: Option<PathBuf>,
}

/// All that was measured.
struct Measured {
    materials: usize,
    combination: Vec<CombinationRow>,
    directions: Vec<DirectionsRow>,
    images: Vec<ImagesRow>,
}

impl Reconstruct {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        if let Some(path) = &self.output {
            output::check(path, &["svg"])?;
        }
        let catalog = Catalog::for_measuring(self.reference.as_deref(), None)?;
        let catalog = if self.validate { catalog.without_validation()? } else { catalog };
        let split = if self.validate { Split::Validation } else { Split::HeldOut };
        let materials = catalog.reference().of(Database::Merl, split);
        if materials.is_empty() {
            let split = if self.validate { "validation" } else { "held-out" };
            return Err(catalog.reference().lacks(&format!("{split} MERL materials"), "none"));
        }
        let steps = combination::steps(self.draws) + directions::steps(self.draws) + images::MOST as u64;
        let bar = progress::bar(steps, "measuring", global.quiet);
        let done = || {
            bar.inc(1);
            progress::check()
        };
        let targets = Targets::new(materials);
        let (seed, draws) = (global.seed(), self.draws);
        let tables = catalog.measured_tables()?;
        let basis = catalog.log_relative()?;
        let seen = SeenComponents::new(&basis, rus32k());
        let measured = Measured {
            materials: targets.materials.len(),
            images: images(&targets, &basis, &seen, &done)?,
            directions: directions(&targets, &basis, &seen, seed, draws, &done)?,
            combination: combination(&targets, &tables, seed, draws, &done)?,
        };
        bar.finish_and_clear();
        if let Some(path) = &self.output {
            let svg = chart::chart(&measured, draws).svg();
            atomic::write(path, svg.as_bytes()).with_context(|| path.display().to_string())?;
        }
        let kind = &catalog.reference().kind;
        let names: Vec<&str> = targets.materials.iter().map(|material| material.name.as_str()).collect();
        let out = json!({
            "schema": 1, "reference": kind, "split": split, "materials": names, "learned_from": tables.tables().len(),
            "draws": draws, "seed": seed, "components": basis.components(), "linear_combination": measured.combination,
            "directions": measured.directions, "sphere_images": measured.images,
        });
        report::print(global, &out, || text(kind, split, draws, &measured))
    }
}

fn text(reference: &str, split: Split, draws: u64, measured: &Measured) -> String {
    let of = if split == Split::HeldOut { "held-out" } else { "validation" };
    format!(
        "Mean errors over {} {of} materials, {draws} random draws: mean ± standard deviation (worst draw); reference: \
         {reference}\n\nMeasured materials as a basis\n\n{}\nA few directions\n\n{}\nPictures of a sphere\n\n{}",
        measured.materials,
        combination_table(&measured.combination),
        directions_table(&measured.directions, measured.materials),
        images_table(&measured.images)
    )
}

fn table(head: &[&str]) -> Table {
    Table::new(head.iter().map(|title| (*title).to_owned()).collect())
}

fn spread(draws: Draws) -> String {
    match draws.sd > 0.0 {
        true => format!("{} ± {} ({})", figure(draws.mean), figure(draws.sd), figure(draws.worst)),
        false => figure(draws.mean),
    }
}

fn combination_table(rows: &[CombinationRow]) -> Table {
    let head = ["sum of", "solve", "samples", "condition", "log_error", "of table's", "relative_log", "of table's"];
    let mut table = table(&head);
    for row in rows {
        table.push(vec![
            if row.domain == "logarithm" { "ln(f cos + 0.001)" } else { "f cos" }.to_owned(),
            row.solve.to_owned(),
            if row.whole_table { format!("all {}", row.samples) } else { row.samples.to_string() },
            figure(row.condition.mean),
            spread(row.log_error),
            format!("{:.2}", row.log_error_ratio),
            spread(row.relative_log),
            format!("{:.2}", row.relative_log_ratio),
        ]);
    }
    table
}

fn directions_table(rows: &[DirectionsRow], materials: usize) -> Table {
    let mut table =
        table(&["chosen by", "directions", "eta", "condition", "log_error", "wins", "relative_log", "wins"]);
    for row in rows {
        let wins = |wins: usize| if row.directions.is_empty() { "-".to_owned() } else { format!("{wins}/{materials}") };
        table.push(vec![
            row.chosen_by.replace('_', " "),
            row.count.to_string(),
            row.damping.to_string(),
            figure(row.condition.mean),
            spread(row.log_error),
            wins(row.log_error_wins),
            spread(row.relative_log),
            wins(row.relative_log_wins),
        ]);
    }
    table
}

fn images_table(rows: &[ImagesRow]) -> Table {
    let mut table = table(&["pictures", "light to viewer, degrees", "pixels", "log_error", "relative_log"]);
    for row in rows {
        let lights: Vec<String> = row.lights.iter().map(u32::to_string).collect();
        let errors = [row.errors.log_error, row.errors.relative_log].map(figure);
        let start = [row.count.to_string(), lights.join(", "), row.pixels.to_string()];
        table.push(start.into_iter().chain(errors).collect());
    }
    table
}
