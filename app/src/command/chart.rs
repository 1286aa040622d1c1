//! `nbrdf chart`: every way to store a material, what it costs against how close it comes.

mod draw;
mod saved;

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use clap::builder::PossibleValuesParser;
use nbrdf_core::cost::REPEATS;
use nbrdf_core::{Database, Material, Split, atomic};

use super::Global;
use crate::catalog::{Catalog, REPRESENTATIONS, RepresentationEntry};
use crate::measure::point::{METRICS, Point};
use crate::measure::quality::Bench;
use crate::report::png::png;
use crate::{output, progress, report};
use saved::Saved;

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
    /// Draw a saved report (`--json`) again, without measuring.
    #[arg(long, value_name = "REPORT", conflicts_with_all = ["quick", "reference", "checkpoint"])]
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
        let svg = draw::scatter(&saved, &self.metric, self.dark).svg();
        let written = match self.output.extension().is_some_and(|extension| extension == "png") {
            true => atomic::write(&self.output, &png(&svg)?),
            false => atomic::write(&self.output, svg.as_bytes()),
        };
        written.with_context(|| format!("{}: cannot be written", self.output.display()))?;
        report::print(global, &saved.json(&self.metric), || draw::text(&saved, &self.metric))
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
        let codes = REPRESENTATIONS.iter().filter(|entry| entry.name == "znbrdf").count();
        let total = (REPRESENTATIONS.len() + codes * others.len()) * bench.count();
        let bar = progress::bar(total as u64, "measuring", global.quiet);
        let measure = |catalog: &Catalog, entry: &RepresentationEntry| -> Result<Option<Point>> {
            bar.set_message(entry.name);
            let representation = entry.build(catalog)?;
            let quality = bench.measure(representation.as_ref(), &catalog.autoencoder(), &|| bar.inc(1))?;
            Ok(Point::of(entry, &quality))
        };
        let mut points = Vec::new();
        for entry in REPRESENTATIONS {
            points.extend(measure(&catalog, entry)?);
        }
        for other in &others {
            for entry in REPRESENTATIONS.iter().filter(|entry| entry.name == "znbrdf") {
                points.extend(measure(other, entry)?);
            }
        }
        bar.finish_and_clear();
        Ok(Saved::new(catalog.reference().kind.clone(), bench.count(), self.quick, points))
    }
}
