//! `nbrdf stress`: all methods under all hazards, and where they fail.

mod heat_map;
mod page;
mod saved;
mod sentences;
mod text;
mod worst;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::atomic;
use nbrdf_core::stress::Group;

use super::Global;
use crate::catalog::{Catalog, INTERPOLATIONS, REPRESENTATIONS};
use crate::failure::Failure;
use crate::measure::stress::{Extent, Setup, hazards};
use crate::report::saved::SavedReport;
use crate::{output, progress, report};

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
    #[arg(long = "hazard", value_name = "NAME")]
    hazards: Vec<String>,
    /// Method to measure: a representation, a way between materials, or reference; all by default. May be given again.
    #[arg(long = "method", value_name = "NAME")]
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

    fn measure(&self, global: &Global) -> Result<Saved> {
        self.check_names()?;
        let catalog = Catalog::for_measuring(self.reference.as_deref(), self.checkpoint.as_deref())?;
        let extent = if self.quick { Extent::QUICK } else { Extent::FULL };
        let extent = Extent { steps: self.steps.map_or(extent.steps, |steps| steps as usize), ..extent };
        let setup = Setup {
            catalog: &catalog,
            extent,
            seed: global.seed(),
            hazards: self.hazards.clone(),
            methods: self.methods.clone(),
        };
        let mut saved = Saved::new(&setup)?;
        let partial = self.partial();
        match (self.resume, partial.exists()) {
            (true, true) => saved = saved.resumed(Saved::load(&partial)?, &partial)?,
            (true, false) => {
                global.warn(format_args!("nothing to go on from at {}: starting anew", partial.display()))?;
            }
            (false, true) => global.warn(format_args!(
                "{} of an interrupted run is written over: --resume would go on with it",
                partial.display()
            ))?,
            (false, false) => {}
        }
        let is_resumed = !saved.groups.is_empty();
        let bar = progress::spinner("measuring", global.quiet);
        for group in Group::ALL {
            if saved.groups.contains(&group) || !setup.wants_any(group) {
                continue;
            }
            let cells = setup.measure(group, &|what| {
                progress::check()?;
                bar.set_message(format!("{}: {what}", group.name()));
                bar.inc(1);
                Ok(())
            });
            saved.cells.extend(cells.with_context(|| self.advice(&saved))?);
            saved.groups.push(group);
            // What is done is done: the next run may go on from here.
            if !saved.cells.is_empty() {
                write(&partial, &serde_json::to_string(&saved)?)?;
            }
        }
        bar.finish_and_clear();
        // Whoever asked for a basis before the interruption is not known any more.
        if !is_resumed {
            catalog.check_used()?;
        }
        if saved.cells.is_empty() {
            return Err(Failure::Usage("no such method is exposed to such a hazard: name others".into()).into());
        }
        Ok(saved)
    }

    /// Where the groups that are done wait for the others.
    fn partial(&self) -> PathBuf {
        self.output.with_extension("partial.json")
    }

    fn advice(&self, saved: &Saved) -> String {
        match saved.groups.is_empty() {
            true => "nothing was finished".to_owned(),
            false => format!("{} keeps what was finished: go on with --resume", self.partial().display()),
        }
    }

    fn check_names(&self) -> Result<()> {
        let groups = Group::ALL.map(Group::name);
        let hazards: Vec<&str> = groups.into_iter().chain(hazards().into_iter().map(|hazard| hazard.name)).collect();
        let methods =
            REPRESENTATIONS.iter().map(|entry| entry.name).chain(INTERPOLATIONS.iter().map(|entry| entry.name));
        let methods: Vec<&str> = methods.chain(["reference"]).collect();
        for (what, names, known) in [("hazard", &self.hazards, &hazards), ("method", &self.methods, &methods)] {
            if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
                return Err(crate::catalog::unknown(what, name, known.iter().copied()));
            }
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
