//! `nbrdf list`: the materials of a library.

use anyhow::Result;
use clap::Args;
use nbrdf_core::library::Entry;
use nbrdf_core::{Database, Split};
use serde_json::{Value, json};

use super::Global;
use crate::material::{Sources, split_of};
use crate::report;

/// Lists the materials of a library.
#[derive(Debug, Args)]
pub struct List {
    #[command(flatten)]
    sources: Sources,
}

impl List {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let shelf = self.sources.open()?;
        shelf.catalog.check_used()?;
        let library = shelf.library();
        let summary = json!({
            "schema": 1,
            "title": library.provenance().title,
            "materials": library.iter().map(row).collect::<Vec<_>>(),
        });
        report::print(global, &summary, || {
            let widest = library.iter().map(|entry| entry.name.chars().count()).max().unwrap_or(0);
            library.iter().map(|entry| line(entry, widest)).collect()
        })
    }
}

fn row(entry: &Entry) -> Value {
    json!({
        "name": entry.name, "database": entry.database, "held_out": entry.held_out, "split": split_of(&entry.name),
        "hidden": entry.network.hidden(), "source_file": entry.source_file, "error": entry.error,
    })
}

fn line(entry: &Entry, widest: usize) -> String {
    let split = match split_of(&entry.name) {
        // Of RGL nothing is learned, held out or not.
        Some(Split::Validation | Split::Train) if entry.database == Database::Rgl => "",
        Some(Split::HeldOut) => "held out",
        Some(Split::Validation) => "validation",
        Some(Split::Train) => "train",
        None => "",
    };
    let line = format!("{:widest$}  {:5}  {split}", entry.name, entry.database.to_string());
    format!("{}\n", line.trim_end())
}
