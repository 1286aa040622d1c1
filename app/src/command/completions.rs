//! `nbrdf completions`: what the Tab key offers.

mod materials;

use anyhow::Result;
use clap::Args;
use clap_complete::Shell;

use crate::report;

/// Prints the completion script of a shell: switches, names of the catalog, and the built-in materials.
#[derive(Debug, Args)]
pub struct Completions {
    /// Which shell.
    shell: Shell,
}

impl Completions {
    /// Runs the command.
    pub fn run(&self) -> Result<()> {
        // Into memory first: the generator panics where a pipe is closed.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut materials::command(), "nbrdf", &mut script);
        report::write(&materials::with_files(self.shell, String::from_utf8(script)?))
    }
}
