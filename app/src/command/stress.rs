//! `nbrdf stress`: all methods under all hazards, and where they fail.

mod heat_map;
mod measured;
mod page;
mod saved;
mod sentences;
mod text;
mod worst;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::atomic;

use super::{Global, names};
use crate::failure::Failure;
use crate::report::saved::SavedReport;
use crate::{output, report};

pub use saved::Saved;

/// Finds where each method fails: hazards × methods, each with a number, a verdict and the worst example.
#[derive(Debug, Args)]
pub struct Stress {
    /// Page with everything in it; a heat map of the same name (.svg) stands beside it.
    #[arg(short, long, value_name = "HTML", default_value = "stress.html")]
    output: PathBuf,
    /// Folder for the worst example of each hazard under which a method fails.
    #[arg(long, value_name = "FOLDER", conflicts_with = "from")]
    pictures: Option<PathBuf>,
    /// Hazard to measure, or a kind of them: directions, numbers, data, physics, learning, paths; all by default. May be
    /// given again.
    #[arg(long = "hazard", value_name = "NAME", value_parser = names::hazards())]
    hazards: Vec<String>,
    /// Method to measure: a representation, a way between materials, or reference; all by default. May be given again.
    #[arg(long = "method", value_name = "NAME", value_parser = names::methods())]
    methods: Vec<String>,
    /// Fewer materials, pairs and steps: minutes instead of an hour.
    #[arg(long)]
    quick: bool,
    /// Go on from what an interrupted run has left beside the page.
    #[arg(long)]
    resume: bool,
    /// Draw a saved report (`--json`) again, without measuring and without pictures.
    #[arg(long, value_name = "REPORT", conflicts_with_all = ["hazards", "methods", "quick", "resume", "reference", "checkpoint"])]
    from: Option<PathBuf>,
    /// Steps of every training of ZNBRDF in the learning hazards; 1000 unless told otherwise, 60 for a quick look.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    steps: Option<u32>,
    /// Materials to measure against; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Another ZNBRDF checkpoint than the built-in one, or a basis of `nbrdf learn`.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Option<PathBuf>,
}

impl Stress {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        if self.output.extension().is_none_or(|extension| extension != "html") {
            let path = self.output.display();
            return Err(Failure::Usage(format!("{path}: expected the extension .html")).into());
        }
        let map = self.output.with_extension("svg");
        for path in [&self.output, &map, &self.partial()] {
            output::check_writable(path)?;
        }
        if let Some(folder) = &self.pictures {
            output::make_folder(folder)?;
        }
        let saved = match &self.from {
            Some(path) => Saved::load(path)?,
            None => self.measure(global)?,
        };
        let [page, svg] = drawn(&saved);
        write(&map, &svg)?;
        write(&self.output, &page)?;
        if let Some(folder) = &self.pictures {
            worst::draw(folder, &saved)?;
        }
        let silent = saved.cells.iter().filter(|cell| cell.is_silent()).count();
        if silent > 0 {
            global.say(format_args!("{silent} of {} cells fail and nothing is said", saved.cells.len()));
        }
        report::print(global, &saved.json(), || text::text(&saved, &self.output))?;
        // Only now is everything where it belongs.
        if self.from.is_none() {
            let _ = std::fs::remove_file(self.partial());
        }
        Ok(())
    }
}

/// The page, and the heat map alone.
pub fn drawn(saved: &Saved) -> [String; 2] {
    let map = heat_map::draw(saved).svg();
    [page::html(saved, &map), map]
}

fn write(path: &Path, text: &str) -> Result<()> {
    atomic::write(path, text.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))
}
