//! `nbrdf linear`: how far linear models of tables carry, and where what they span could not exist.

mod charts;

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::metric::{Spread, albedo_max};
use nbrdf_core::rank::{Frame, ROWS, SingularValues};
use nbrdf_core::representation::values::Values;
use nbrdf_core::{Database, Material, Split, atomic};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use super::Global;
use crate::catalog::Catalog;
use crate::measure::linear::{Kind, linear, points};
use crate::report::table::Table;
use crate::{output, progress, report};

/// Kinds of values whose singular values are measured.
const RANKED: [Values; 2] = [Values::Plain, Values::Log];
/// Ranks whose share of energy is reported.
const RANKS: [usize; 6] = [1, 2, 3, 5, 10, 20];
/// Share of energy that is asked for.
const MOST: f64 = 0.999;

/// Measures linear models of tables: PCA of three kinds of values on held-out materials and on what it spans between and
/// around the training materials, and the rank of tables over two sets of angles.
///
/// Negative: f cos is below -0.001 in more than 1 % of directions. Violating: more light leaves than arrives. Off: further
/// from the nearest training material than nine in ten of these are from theirs.
#[derive(Debug, Args)]
pub struct Linear {
    /// Materials to measure; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Points drawn from the Gaussian of the training codes, 1 to 100000.
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    draws: u32,
    /// Chart of the shares of points that could not exist (.svg).
    #[arg(short, long, value_name = "SVG")]
    output: Option<PathBuf>,
    /// Chart of the singular values (.svg).
    #[arg(long, value_name = "SVG")]
    ranks: Option<PathBuf>,
}

/// Singular values of one kind over one frame, of all materials.
#[derive(Debug, Serialize)]
struct Ranks {
    frame: Frame,
    values: Values,
    /// Over the first of each material, mean of the logarithms.
    singular_values: Vec<f64>,
    /// Share of the sum of squares at each of [`RANKS`], mean.
    energy: Vec<f64>,
    effective_rank: Option<Spread>,
    /// Fewest products that hold [`MOST`] of the sum of squares.
    rank: Option<Spread>,
}

impl Linear {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        for path in [&self.output, &self.ranks].into_iter().flatten() {
            output::check(path, &["svg"])?;
        }
        let catalog = Catalog::for_measuring(self.reference.as_deref(), None)?;
        let reference = catalog.reference();
        let training = catalog.training_materials();
        let held_out = reference.of(Database::Merl, Split::HeldOut);
        if training.len() < 3 || held_out.is_empty() {
            let found = format!("{} and {}", training.len(), held_out.len());
            return Err(reference.lacks("3 or more MERL materials to learn from and 1 held-out one", found));
        }
        let all: Vec<&Material> = training.iter().chain(held_out.iter().copied()).collect();
        let draws = self.draws as usize;
        let length = all.len() + Values::ALL.len() * points(training.len(), held_out.len(), draws);
        let bar = progress::bar(length as u64, "measuring", global.quiet);
        let ranks = ranks(&all, &|| bar.inc(1))?;
        let kind = |values| linear(values, &training, &held_out, (draws, global.seed()), &|| bar.inc(1));
        let kinds = Values::ALL.into_iter().map(kind).collect::<Result<Vec<_>>>()?;
        bar.finish_and_clear();
        for (path, chart) in
            [(&self.output, charts::unphysical(&kinds)), (&self.ranks, charts::ranks(&ranks, all.len()))]
        {
            if let Some(path) = path {
                atomic::write(path, chart.svg().as_bytes()).with_context(|| path.display().to_string())?;
            }
        }
        let violating = all.par_iter().filter(|material| albedo_max(material.brdf.as_ref()) > 1.0).count();
        let out = json!({
            "schema": 1, "reference": reference.kind, "training": training.len(), "held_out": held_out.len(),
            "draws": draws, "seed": global.seed(), "violating_reference": violating as f64 / all.len() as f64,
            "ranks": RANKS, "rank_energy": MOST, "singular_values": ranks, "kinds": kinds,
        });
        report::print(global, &out, || text(&out, &ranks, &kinds))
    }
}

/// Of every material, in parallel; `done` is called after each.
fn ranks(materials: &[&Material], done: &(dyn Fn() + Sync)) -> Result<Vec<Ranks>> {
    let cases = || Frame::ALL.into_iter().flat_map(|frame| RANKED.map(|values| (frame, values)));
    let one = |material: &&Material| -> Result<Vec<Option<SingularValues>>> {
        progress::check()?;
        let brdf = material.brdf.as_ref();
        let found = cases().map(|(frame, values)| SingularValues::of(brdf, frame, values)).collect();
        done();
        Ok(found)
    };
    let found = materials.par_iter().map(one).collect::<Result<Vec<_>>>()?;
    let case = |(index, (frame, values)): (usize, (Frame, Values))| {
        // A black material has no singular values.
        let of =
            || materials.iter().zip(&found).filter_map(|(m, found)| Some((m.name.as_str(), found[index].as_ref()?)));
        let count = of().count().max(1) as f64;
        let normalised: Vec<Vec<f64>> = of().map(|(_, found)| found.normalised()).collect();
        let logs = |i: usize| normalised.iter().map(|values| values[i].max(1e-12).ln()).sum::<f64>();
        Ranks {
            frame,
            values,
            singular_values: (0..ROWS).map(|i| (logs(i) / count).exp()).collect(),
            energy: RANKS.map(|rank| of().map(|(_, found)| found.energy(rank)).sum::<f64>() / count).to_vec(),
            effective_rank: Spread::new(of().map(|(name, found)| (name, found.effective_rank())), false),
            rank: Spread::new(of().map(|(name, found)| (name, found.rank_for(MOST) as f64)), false),
        }
    };
    Ok(cases().enumerate().map(case).collect())
}

fn text(out: &Value, ranks: &[Ranks], kinds: &[Kind]) -> String {
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let spread = |spread: &Option<Spread>| {
        spread.as_ref().map_or_else(String::new, |s| format!("{} ({})", report::figure(s.mean), report::figure(s.max)))
    };
    let mut frames = Table::new(
        ["table", "effective rank", "rank for 99.9 %", "energy of 1", "of 3", "of 10"].map(str::to_owned).to_vec(),
    );
    for row in ranks {
        let mut cells = vec![format!("{} {}", row.frame.name(), row.values.name())];
        cells.extend([spread(&row.effective_rank), spread(&row.rank)]);
        cells.extend([0, 2, 4].map(|i| format!("{:.2} %", 100.0 * row.energy[i])));
        frames.push(cells);
    }
    let head = [
        "PCA",
        "held out: log_error",
        "negative",
        "lowest f cos",
        "violating",
        "off",
        "between: negative",
        "violating",
        "off",
        "drawn: negative",
        "violating",
        "off",
    ];
    let mut span = Table::new(head.map(str::to_owned).to_vec());
    for kind in kinds {
        for row in &kind.rows {
            let mut cells = vec![format!("{} {}", kind.values.name(), row.components), spread(&row.held_out.log_error)];
            cells.extend([percent(row.held_out.negative), report::figure(row.held_out.lowest)]);
            cells.extend([percent(row.held_out.violating), percent(row.held_out.off)]);
            for group in [&row.between, &row.drawn] {
                cells.extend([group.negative, group.violating, group.off].map(percent));
            }
            span.push(cells);
        }
    }
    let share = out["violating_reference"].as_f64().unwrap_or(f64::NAN);
    format!(
        "Tables of 90 x 90 x 180 cells as sums of products, mean (largest) over {} materials, reference: {}\n\n{frames}\n\
         What {} training materials span: {} held-out materials as mean (worst), middles of pairs, and {} points drawn \
         from the Gaussian of the codes. Shares of points whose f cos is below -0.001 in more than 1 % of directions, \
         that violate energy ({} of the reference materials do), and further off the training materials than nine in \
         ten of these\n\n{span}",
        out["training"].as_u64().unwrap_or(0) + out["held_out"].as_u64().unwrap_or(0),
        out["reference"].as_str().unwrap_or_default(),
        out["training"],
        out["held_out"],
        out["draws"],
        percent(share),
    )
}
