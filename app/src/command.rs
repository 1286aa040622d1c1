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
pub mod fit;
pub mod import;
pub mod info;
pub mod learn;
pub mod linear;
pub mod list;
pub mod manifold;
pub mod plan;
pub mod reconstruct;
pub mod render;
pub mod sampling;
pub mod speed;
pub mod train;

use anyhow::{Result, bail};
use clap::Args;
use nbrdf_core::Material;
use nbrdf_core::metric::albedo_max;

use crate::material::{Item, Shelf};

/// Switches that every command takes.
#[derive(Debug, Clone, Args)]
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
            eprintln!("{remark}");
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

    /// Warns of a material that reflects more light than it gets.
    pub fn check_energy(&self, name: &str, albedo_max: f64) -> Result<()> {
        if albedo_max > 1.0 {
            self.warn(format_args!("{name}: albedo_max is {albedo_max:.3}: more light leaves than arrives"))?;
        }
        Ok(())
    }
}

/// Codes of ZNBRDF that are farther from those of training, in distances between neighbours among these, are of no
/// material: measured ones stay below 6.
const FARTHEST: f64 = 20.0;

/// Warns of a code that no material has.
fn warn_of_distance(global: &Global, item: &Item, shelf: &Shelf) -> Result<()> {
    let Some(code) = &item.code else { return Ok(()) };
    match shelf.catalog.autoencoder().distance(code)? {
        Some(distance) if distance.is_nan() || distance > FARTHEST => global.warn(format_args!(
            "{}: the code is {distance:.0} times as far from those of training as these are from each other: was it edited by hand?",
            item.material.name
        )),
        _ => Ok(()),
    }
}

/// Warns of a material that reflects more light than it gets.
fn warn_of_energy(global: &Global, material: &Material) -> Result<()> {
    global.check_energy(&material.name, albedo_max(material.brdf.as_ref()))
}
