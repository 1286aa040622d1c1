//! `nbrdf chart`: every way to store a material, what it costs against how close it comes.

mod draw;
mod files;
mod models;
mod saved;
mod stability;
mod text;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use clap::builder::PossibleValuesParser;
use nbrdf_core::cost::REPEATS;
use nbrdf_core::{Database, Material, Split};

use super::Global;
use crate::catalog::Catalog;
use crate::measure::point::METRICS;
use crate::measure::quality::Bench;
use crate::report::saved::SavedReport;
use crate::{output, progress, report};
use models::Models;
use saved::MOST_RUNS;

pub use draw::scatter;
pub use saved::Saved;

/// Materials, repeats of a quick look.
const QUICK: (usize, usize) = (4, 9);

/// Charts speed, bytes and encoding time of every representation against its error on held-out materials.
#[derive(Debug, Args)]
pub struct Chart {
    /// File of the chart.
    #[arg(short, long, value_name = "SVG|PNG", default_value = "chart.svg")]
    output: PathBuf,
    /// Error to show.
    #[arg(long, default_value = METRICS[0], value_parser = PossibleValuesParser::new(METRICS))]
    metric: String,
    /// Fewer materials and fewer repeats: within a minute.
    #[arg(long)]
    quick: bool,
    /// Times are medians over this many runs, and the report tells whether each has the same front.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=MOST_RUNS as i64))]
    runs: u8,
    /// Draw a saved report (`--json`) again, without measuring.
    #[arg(long, value_name = "REPORT", conflicts_with_all = ["quick", "runs", "reference", "checkpoint"])]
    from: Option<PathBuf>,
    /// Materials to measure against; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Another ZNBRDF checkpoint, of any length, beside the built-in one; may be repeated.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Vec<PathBuf>,
    /// Dark, whatever the reader prefers.
    #[arg(long)]
    dark: bool,
}

impl Chart {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &["svg", "png"])?;
        let saved = match &self.from {
            Some(path) => Saved::load(path)?,
            None => self.measure(global)?,
        };
        saved.check_metric(&self.metric)?;
        output::write_chart(&self.output, &scatter(&saved, &self.metric, self.dark).svg())?;
        report::print(global, &saved.json(&self.metric), || text::text(&saved, &self.metric))
    }

    fn measure(&self, global: &Global) -> Result<Saved> {
        let catalog = Catalog::for_measuring(self.reference.as_deref(), None)?;
        let all = catalog.reference().of(Database::Merl, Split::HeldOut);
        if all.is_empty() {
            return Err(catalog.reference().lacks("held-out MERL materials", "none"));
        }
        let (count, repeats) = if self.quick { QUICK } else { (all.len(), REPEATS) };
        let materials: Vec<&Material> = all.iter().copied().step_by(all.len().div_ceil(count)).collect();
        let others = self
            .checkpoint
            .iter()
            .map(|path| Catalog::for_measuring(self.reference.as_deref(), Some(path)))
            .collect::<Result<Vec<_>>>()?;
        others.iter().try_for_each(Catalog::check_used)?;
        let bench = Bench::new(materials, global.seed(), repeats);
        let models = Models::new(&catalog, others.into_iter().zip(files::names(&self.checkpoint)))?;
        let runs = usize::from(self.runs);
        let bar = progress::bar((runs * models.count() * bench.count()) as u64, "measuring", global.quiet);
        let points = models.measure(&bench, runs, &bar)?;
        bar.finish_and_clear();
        let (reference, materials) = (catalog.reference().kind.clone(), bench.count());
        Ok(Saved { schema: 1, reference, materials, quick: self.quick, runs, points })
    }
}
