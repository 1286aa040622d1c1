//! The subcommands, one file each.

pub mod axes;
pub mod blend;
pub mod chart;
pub mod compare;
pub mod completions;
pub mod decode;
pub mod edit;
pub mod encode;
pub mod evaluate;
pub mod export;
pub mod fit;
pub mod import;
pub mod info;
pub mod learn;
pub mod linear;
pub mod list;
pub mod man;
pub mod manifold;
mod names;
pub mod plan;
pub mod reconstruct;
pub mod render;
pub mod sampling;
pub mod speed;
pub mod stress;
pub mod train;

use anyhow::{Result, bail};
use clap::Args;
use nbrdf_core::Warning;

use crate::material::{Item, Shelf};
use crate::measure::guard;
use crate::visible::visible;

/// Switches that every command takes.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Options of every command")]
pub struct Global {
    /// Print the report as JSON on stdout.
    #[arg(long, global = true)]
    pub json: bool,
    /// Seed of everything random.
    #[arg(long, global = true, value_name = "N")]
    seed: Option<u64>,
    /// Threads to use, 1 to 1024; all cores by default.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// No progress bars, no remarks.
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Take warnings for errors.
    #[arg(long, global = true)]
    pub strict: bool,
}

impl Global {
    /// The seed; 0 unless given.
    pub fn seed(&self) -> u64 {
        self.seed.unwrap_or(0)
    }

    /// A remark on stderr, unless quiet.
    pub fn say(&self, remark: std::fmt::Arguments) {
        if !self.quiet {
            eprintln!("{}", visible(&remark.to_string()));
        }
    }

    /// A warning on stderr, unless quiet; with `--strict` an error.
    pub fn warn(&self, warning: std::fmt::Arguments) -> Result<()> {
        if self.strict {
            bail!("{warning} (a warning, but for --strict)");
        }
        self.say(format_args!("warning: {warning}"));
        Ok(())
    }

    /// Warnings of a material on stderr, as [`warn`](Self::warn) does.
    pub fn warn_of(&self, name: &str, warnings: impl IntoIterator<Item = Warning>) -> Result<()> {
        warnings.into_iter().try_for_each(|warning| self.warn(format_args!("{name}: {warning}")))
    }
}

/// What is to be said of a code that no material has.
fn of_code(item: &Item, shelf: &Shelf) -> Result<Option<Warning>> {
    let Some(code) = &item.code else { return Ok(None) };
    Ok(guard::of_distance(code, &shelf.catalog.autoencoder())?)
}
