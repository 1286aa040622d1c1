//! `nbrdf import`: published networks into a library; with a fit, networks of this project's own.

mod derived;

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;
use nbrdf_core::Library;
use nbrdf_core::library::refit::{Event, Start, refit};
use nbrdf_core::library::{Entry, Provenance, scan};
use nbrdf_core::nbrdf::fit::FitOptions;

use super::Global;
use crate::failure::Failure;
use crate::{input, output, progress, report};
use derived::{derived, file_name};

/// Reads published networks (.zip, .h5, .npy sets, .npz, .safetensors, folders) into a library.
///
/// Everything is read and checked before anything is fitted or written.
#[derive(Debug, Args)]
pub struct Import {
    /// Archives, folders or files of networks.
    #[arg(required = true, value_name = "SRC")]
    sources: Vec<PathBuf>,
    /// Folder of the library to write; one that is there is replaced, and nothing else.
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

    /// Refuses a folder that cannot be written, before the work, and one with such files of something else: asks the nearest
    /// folder that is there already.
    fn check_output(&self) -> Result<()> {
        let there = |path: &&Path| path.as_os_str().is_empty() || path.exists();
        let nearest = self.output.ancestors().find(there).unwrap_or(Path::new("."));
        output::check_writable(&nearest.join("manifest.json"))?;
        Ok(Library::check_folder(&self.output)?)
    }

    fn read(&self, source: &Path, entries: &mut Vec<Entry>, global: &Global) -> Result<()> {
        input::check(source, "an archive, a folder or a file of networks")?;
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
