//! `nbrdf manifold`: how many dimensions materials have, what a chart of them keeps, and a map.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::render::Sphere;
use nbrdf_core::representation::charting::dimension::{Growth, growth, intrinsic_dimension};
use nbrdf_core::{Database, Material, Rgb, Split, atomic};
use serde_json::{Value, json};

use super::Global;
use crate::catalog::Catalog;
use crate::measure::manifold::{Coordinates, NEIGHBOURS, Placed, Row};
use crate::measure::standard_pairs;
use crate::report::svg::map::{Map, Place};
use crate::report::table::Table;
use crate::{output, progress, report};

/// Training materials that a chart of 15 dimensions needs.
const LEAST: usize = 17;

/// Measures the manifold of MERL materials: its dimension over scale, and charts of it beside principal components.
///
/// Distances are compared with the shortest ways over nearest neighbours, reconstructions with held-out materials, points
/// halfway between the standard pairs with what a material may be.
#[derive(Debug, Args)]
pub struct Manifold {
    /// Materials to chart; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Only the first N pairs.
    #[arg(long, value_name = "N")]
    pairs: Option<usize>,
    /// Map to write (.svg).
    #[arg(short, long, value_name = "SVG")]
    output: Option<PathBuf>,
}

impl Manifold {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        if let Some(path) = &self.output {
            output::check(path, &["svg"])?;
        }
        let catalog = Catalog::for_measuring(self.reference.as_deref(), None)?;
        let reference = catalog.reference();
        let is_merl = |material: &&Material| Database::of(&material.name) == Database::Merl;
        let mut materials: Vec<&Material> = reference.materials.iter().filter(is_merl).collect();
        materials.sort_by(|a, b| a.name.cmp(&b.name));
        let training = materials.iter().filter(|material| Split::of(&material.name).is_training()).count();
        if training < LEAST {
            return Err(reference.lacks(&format!("{LEAST} MERL training materials or more"), training));
        }
        let span = catalog.span()?;
        let growth = growth(span.training());
        let placed = Placed::new(Arc::clone(&span), materials)?;
        let count = placed.materials.len();
        let pairs: Vec<_> = standard_pairs(count).take(self.pairs.unwrap_or(count)).collect();
        let (map, full) = (catalog.charting_2()?, catalog.charting_15()?);
        let all = [
            Coordinates::Principal(map.atlas().dim()),
            Coordinates::Chart(map),
            Coordinates::Principal(full.atlas().dim()),
            Coordinates::Chart(full),
        ];
        let bar = progress::bar(all.len() as u64, "charting", global.quiet);
        let measured = all.iter().map(|coordinates| {
            let row = placed.measure(coordinates, &pairs)?;
            bar.inc(1);
            Ok(row)
        });
        let rows = measured.collect::<Result<Vec<Row>>>()?;
        bar.finish_and_clear();
        if let Some(path) = &self.output {
            let svg = drawn(&placed, &all[1], &rows).svg();
            atomic::write(path, svg.as_bytes()).with_context(|| path.display().to_string())?;
        }
        let dimension = intrinsic_dimension(&growth);
        let out = json!({
            "schema": 1, "reference": reference.kind, "materials": count, "training": training, "pairs": pairs.len(),
            "neighbours": NEIGHBOURS, "growth": growth, "intrinsic_dimension": dimension, "rows": rows,
        });
        report::print(global, &out, || text(&out, &growth, dimension, &rows))
    }
}

fn text(out: &Value, growth: &[Growth], dimension: Option<Growth>, rows: &[Row]) -> String {
    let mut scales = Table::new(["nearest", "radius", "dimension"].map(str::to_owned).to_vec());
    for step in growth {
        scales.push(vec![step.count.to_string(), report::figure(step.radius), report::figure(step.dimension)]);
    }
    let head = [
        "coordinates",
        "stress",
        "correlation",
        "(training)",
        "",
        "log_error",
        "worst",
        "middles < 0",
        "albedo > 1",
        "to nearest training",
    ];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    for row in rows {
        let mean = |spread: &Option<nbrdf_core::metric::Spread>| spread.as_ref().map_or(f64::NAN, |s| s.mean);
        let worst = row.log_error.as_ref().map_or(f64::NAN, |spread| spread.max);
        let mut cells = vec![row.name.clone()];
        let figures = [
            row.distances.stress,
            row.distances.correlation,
            row.train_distances.stress,
            row.train_distances.correlation,
            mean(&row.log_error),
            worst,
            mean(&row.middles.negative_share),
        ];
        cells.extend(figures.map(report::figure));
        cells.push(row.middles.energy_violations.to_string());
        cells.push(report::figure(mean(&row.middles.nearest_training)));
        table.push(cells);
    }
    let dimension = dimension.map_or(f64::NAN, |growth| growth.dimension);
    format!(
        "{} MERL materials, {} of them learned from, reference: {}\n\nDimension over scale, first peak {}\n\n{scales}\n\
         Distances against ways over {NEIGHBOURS} neighbours (pairs with a held-out material, then training alone), \
         held-out materials decoded, and {} middles of pairs\n\n{table}",
        out["materials"],
        out["training"],
        out["reference"].as_str().unwrap_or_default(),
        report::figure(dimension),
        out["pairs"],
    )
}

/// The map, and what it shows.
fn drawn(placed: &Placed, coordinates: &Coordinates, rows: &[Row]) -> Map {
    let place = |i: usize| {
        let at = coordinates.forward(&placed.places[i]);
        let material = placed.materials[i];
        Place { name: material.name.clone(), at: [at[0], at[1]], colour: colour(material), marked: placed.held_out[i] }
    };
    let mean = |row: &Row| row.table_error.as_ref().map_or(f64::NAN, |spread| spread.mean);
    let [linear, chart] = [&rows[0], &rows[1]];
    let nearer = 100.0 * (1.0 - mean(chart) / mean(linear));
    Map {
        title: match nearer > 0.0 {
            true => format!("Two chart coordinates come {nearer:.0} % nearer to held-out materials than two of PCA"),
            false => "Two chart coordinates come no nearer to held-out materials than two of PCA".to_owned(),
        },
        subtitle: format!(
            "{} MERL materials; error of ln(f cos + 0.001) {} against {}; distances correlate with ways along the \
             manifold by {} against {}; squares: held out",
            placed.materials.len(),
            report::figure(mean(chart)),
            report::figure(mean(linear)),
            report::figure(chart.distances.correlation),
            report::figure(linear.distances.correlation),
        ),
        places: (0..placed.materials.len()).map(place).collect(),
    }
}

/// Mean colour of the material's sphere as displayed.
fn colour(material: &Material) -> [u8; 3] {
    let sphere = Sphere::studio();
    let picture = sphere.render(material.brdf.as_ref()).displayed();
    let covered = || picture.pixels().iter().zip(sphere.covered()).filter(|(_, covered)| **covered);
    let count = covered().count().max(1) as f32;
    let sum = covered().fold(Rgb::BLACK, |sum, (pixel, _)| sum.zip(*pixel, |a, b| a + b));
    sum.0.map(|v| (255.0 * v / count).clamp(0.0, 255.0).round() as u8)
}
