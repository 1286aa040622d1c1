//! `nbrdf import`: published networks into a library; with a fit, networks of this project's own.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::Library;
use nbrdf_core::hash::sha256;
use nbrdf_core::library::refit::{Event, Start, refit};
use nbrdf_core::library::{Entry, Provenance, Source, scan};
use nbrdf_core::nbrdf::fit::FitOptions;

use super::Global;
use crate::failure::Failure;
use crate::{output, progress, report};

/// Reads published networks (.zip, .h5, .npy sets, .npz, .safetensors, folders) into a library.
///
/// Everything is read and checked before anything is fitted or written.
#[derive(Debug, Args)]
pub struct Import {
    /// Archives, folders or files of networks.
    #[arg(required = true, value_name = "SRC")]
    sources: Vec<PathBuf>,
    /// Folder of the library to write.
    #[arg(short, long, value_name = "LIBRARY")]
    output: PathBuf,
    /// Fit every network again from one shared initial network, so that weights can be mixed.
    #[arg(long)]
    shared_start: bool,
    /// Fit every network again, each from a random start of its own.
    #[arg(long, conflicts_with = "shared_start")]
    independent: bool,
    /// Steps of each fit.
    #[arg(long, default_value_t = 30_000, value_parser = clap::value_parser!(u32).range(1..))]
    steps: u32,
    /// Leave out what cannot be read instead of stopping.
    #[arg(long)]
    skip_bad: bool,
}

impl Import {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        self.check_output()?;
        let mut entries = Vec::new();
        for source in &self.sources {
            self.read(source, &mut entries, global)?;
        }
        entries.sort_by(|a, b| (a.database, &a.name).cmp(&(b.database, &b.name)));
        if entries.is_empty() {
            return Err(Failure::InvalidFile("no readable network in any source".into()).into());
        }
        // Names are checked before anything is fitted.
        Library::new(Provenance::default(), None, entries.clone())?;
        let library = self.library(&entries, global)?;
        library.save(&self.output)?;
        let summary = report::imported(&library, &self.output);
        report::print(global, &summary, || format!("{} materials in {}\n", library.len(), self.output.display()))
    }

    /// Refuses a folder that cannot be written, before the work: asks the nearest folder that is there already.
    fn check_output(&self) -> Result<()> {
        let there = |path: &&Path| path.as_os_str().is_empty() || path.exists();
        let nearest = self.output.ancestors().find(there).unwrap_or(Path::new("."));
        output::check_writable(&nearest.join("manifest.json"))
    }

    fn read(&self, source: &Path, entries: &mut Vec<Entry>, global: &Global) -> Result<()> {
        for scanned in scan(source)? {
            match scanned.entry {
                Ok(entry) => entries.push(entry),
                Err(error) if self.skip_bad => global.say(format_args!("left out: {error}")),
                Err(error) => {
                    return Err(Failure::InvalidFile(format!("{error} (--skip-bad leaves such files out)")).into());
                }
            }
        }
        Ok(())
    }

    fn library(&self, entries: &[Entry], global: &Global) -> Result<Library> {
        let (start, options) = match (self.shared_start, self.independent) {
            (true, _) => (Start::Shared, FitOptions::shared_start(global.seed())),
            (_, true) => (Start::Independent, FitOptions { seed: global.seed(), ..FitOptions::default() }),
            _ => return Ok(Library::new(self.provenance(global)?, None, entries.to_vec())?),
        };
        let options = FitOptions { steps: self.steps as usize, ..options };
        let bar = progress::bar(entries.len() as u64, "fitting", global.quiet);
        let on_event = |event| match event {
            Event::FittingStart => bar.set_message("shared start"),
            Event::Fitted => {
                bar.set_message("");
                bar.inc(1);
            }
        };
        let provenance = self.provenance(global)?;
        let library = refit(entries, start, options, provenance, &on_event, &progress::cancelled)?;
        bar.finish_and_clear();
        Ok(library)
    }

    fn provenance(&self, global: &Global) -> Result<Provenance> {
        let kind = match (self.shared_start, self.independent) {
            (true, _) => "Networks refitted from one shared initial network",
            (_, true) => "Networks refitted, each from a random start of its own",
            _ => "Networks as published",
        };
        let names: Vec<String> = self.sources.iter().map(|source| file_name(source)).collect();
        let mut command = format!("nbrdf import {}", names.join(" "));
        if self.shared_start {
            command += " --shared-start";
        }
        if self.independent {
            command += " --independent";
        }
        if self.shared_start || self.independent {
            command += &format!(" --steps {} --seed {}", self.steps, global.seed());
        }
        let derived_from = self.sources.iter().map(|source| derived(source)).collect::<Result<_>>()?;
        Ok(Provenance { title: kind.to_owned(), command, seed: global.seed(), derived_from })
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// SHA-256 of the published archives, by which they are recognised.
const PUBLISHED: [&str; 2] = [
    "de79644946de1870f2dea6805ae8b4bdaa36bc55c33ef5a135223bdfcdb3ab80",
    "40995a4de63af018c3d93f1589d102170e7cd16a4f6c91e6a798656bce013a2c",
];

/// What a source is, who published it, on which terms.
fn derived(path: &Path) -> Result<Source> {
    let sum = match path.is_file() {
        true => sha256(&std::fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))?),
        false => String::new(),
    };
    let (source, terms) = match PUBLISHED.contains(&sum.as_str()) {
        true => (
            "Sztrajman, Rainer, Ritschel, Weyrich 2021, Neural BRDF Representation and Importance Sampling, \
             doi 10.1111/cgf.14335: published network weights",
            "MIT; the measurements behind them: MERL BRDF database (Matusik et al. 2003), \
             RGL material database (Dupuy and Jakob 2018)",
        ),
        false => ("not known to this program", "ask who made it"),
    };
    Ok(Source { file: file_name(path), sha256: sum, source: source.into(), terms: terms.into() })
}
