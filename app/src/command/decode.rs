//! `nbrdf decode`: a code as the network, the table or the program it stands for.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use nbrdf_core::Nbrdf;
use nbrdf_core::extensions::listed;
use serde_json::json;

use super::{Global, of_code};
use crate::catalog::exporters::{EXPORTERS, ExporterEntry, Needs, Subject};
use crate::exported::{self, FileSet};
use crate::failure::Failure;
use crate::material::{STDIN, Sources};
use crate::measure::guard;
use crate::report;
use crate::shell::quoted;

/// Turns a code into the file of a network, of a table, or of any other form that `nbrdf export` writes, with a manifest.
#[derive(Debug, Args)]
pub struct Decode {
    /// File of a code; `-` for standard input.
    code: String,
    #[arg(short, long, value_name = "OUT", help = help())]
    output: PathBuf,
    #[command(flatten)]
    sources: Sources,
}

/// Extensions of what a code may become: anything but a code.
fn extensions() -> Vec<&'static str> {
    EXPORTERS.iter().filter(|entry| entry.needs != Needs::Code).map(|entry| entry.extension).collect()
}

fn help() -> String {
    format!(
        "File to write, whose extension says the form: {}; `nbrdf export --list` tells of them",
        listed(&extensions())
    )
}

impl Decode {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let set = self.set()?;
        set.check(&std::iter::once(self.code.clone()).chain(self.sources.inputs()).collect::<Vec<_>>())?;
        let shelf = self.sources.open()?;
        let item = shelf.code(&self.code)?;
        shelf.catalog.check_used()?;
        let name = &item.material.name;
        global.warn_of(name, of_code(&item, &shelf)?)?;
        let model = item.code.as_ref().map_or("", |code| code.model.as_str());
        let subject = Subject { material: &item.material, code: item.code.as_ref() };
        let network = subject.network();
        if network.is_none() && set.form.needs == Needs::Network {
            let code = if self.code == STDIN { "CODE" } else { &self.code };
            return Err(Failure::Usage(format!(
                "a code of {model} stands for a table, not for a network: `nbrdf render {code}` shows it, -o OUT.binary \
                 writes it; `nbrdf encode --with znbrdf` makes codes that decode to networks"
            ))
            .into());
        }
        global.warn_of(name, guard::of_result(item.material.brdf.as_ref()))?;
        let output = quoted(&set.named().to_string_lossy());
        let command = format!("nbrdf decode {} -o {output}{}", quoted(&self.code), self.sources.options());
        let made = set.make(&subject, &shelf.catalog, &command, global)?;
        let summary = json!({
            "schema": 1, "material": name, "model": model, "hidden": network.map(Nbrdf::hidden),
            "weights": network.map(|network| network.weights().len()), "output": self.output.display().to_string(),
            "error": made.manifest["error"], "files": made.manifest["files"], "manifest": set.manifest().display().to_string(),
        });
        set.write(made)?;
        report::print(global, &summary, || exported::line(&summary))
    }

    /// The files of the form that the extension says.
    fn set(&self) -> Result<FileSet> {
        let form = ExporterEntry::of(&self.output).filter(|form| form.needs != Needs::Code);
        let form = form.ok_or_else(|| {
            let path = self.output.display();
            Failure::Usage(format!("{path}: expected the extension {}", listed(&extensions())))
        })?;
        Ok(FileSet { form, stem: self.output.with_extension(""), is_named: true })
    }
}
