//! `nbrdf export`: materials in the forms that other programs read.

mod destination;
mod listed;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};

use super::{Global, names, of_code};
use crate::catalog::ExporterEntry;
use crate::catalog::exporters::Subject;
use crate::exported::{self, FileSet};
use crate::material::{Item, Shelf, Sources};
use crate::measure::guard;
use crate::shell::quoted;
use crate::{progress, report};
use destination::Destination;

/// Writes materials in a form that other programs read, each with a manifest: what it is of, what its numbers mean, and how
/// far it is from its source.
#[derive(Debug, Args)]
pub struct Export {
    /// Names of materials, files of networks or measurements, or codes (one may be `-` for standard input).
    #[arg(value_name = "MATERIAL|CODE|FILE", required_unless_present = "list")]
    materials: Vec<String>,
    /// The form; that of OUT's extension by default.
    #[arg(long, value_name = "FORM", value_parser = names::forms())]
    to: Option<String>,
    /// File to write, whose extension may be left out where --to says the form; a folder for several materials.
    #[arg(short, long, value_name = "OUT", required_unless_present_any = ["list", "measure"])]
    output: Option<PathBuf>,
    /// Only measure how far the form is from the materials; write nothing.
    #[arg(long, requires = "to", conflicts_with = "output")]
    measure: bool,
    /// List all forms.
    #[arg(long, conflicts_with_all = ["materials", "to", "output", "measure"])]
    list: bool,
    #[command(flatten)]
    sources: Sources,
}

impl Export {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        if self.list {
            return listed::print(global);
        }
        let to = Destination::new(self.to.as_deref(), self.output.as_deref(), self.materials.len())?;
        let shelf = self.sources.open()?;
        let items = self.items(&shelf, to.form, global)?;
        shelf.catalog.check_used()?;
        let sets = to.sets(items.iter().map(|item| item.material.name.as_str()))?;
        if !self.measure {
            to.make_folder()?;
            let inputs: Vec<String> = self.materials.iter().cloned().chain(self.sources.inputs()).collect();
            sets.iter().try_for_each(|set| set.check(&inputs))?;
        }
        let bar = progress::bar(items.len() as u64, to.form.name, global.quiet);
        let mut exports = Vec::new();
        for ((argument, item), set) in self.materials.iter().zip(&items).zip(&sets) {
            progress::check()?;
            bar.set_message(item.material.name.clone());
            exports.push(self.export(item, argument, set, &shelf, global)?);
            bar.inc(1);
        }
        bar.finish_and_clear();
        let summary = json!({"schema": 1, "form": to.form.name, "exports": exports});
        report::print(global, &summary, || exports.iter().map(exported::line).collect())
    }

    /// What is to be written, all of it known before any is.
    fn items(&self, shelf: &Shelf, form: &ExporterEntry, global: &Global) -> Result<Vec<Item>> {
        let item = |argument: &String| -> Result<Item> {
            let item = shelf.any(argument)?;
            let subject = Subject { material: &item.material, code: item.code.as_ref() };
            form.check(&subject)?;
            let brdf = item.material.brdf.as_ref();
            let energy = guard::of_energy(item.albedo_max());
            let told = of_code(&item, shelf)?.into_iter().chain(energy).chain(guard::of_use(brdf));
            global.warn_of(&item.material.name, told)?;
            Ok(item)
        };
        self.materials.iter().map(item).collect()
    }

    /// Writes one material, unless it is only measured; what is told of it.
    fn export(&self, item: &Item, argument: &str, set: &FileSet, shelf: &Shelf, global: &Global) -> Result<Value> {
        let subject = Subject { material: &item.material, code: item.code.as_ref() };
        let output = format!("{} -o {}", set.form.name, quoted(&set.named().to_string_lossy()));
        let command = format!("nbrdf export {} --to {output}{}", quoted(argument), self.sources.options());
        let made = set.make(&subject, &shelf.catalog, &command, global)?;
        let told = json!({
            "material": item.material.name, "files": made.manifest["files"], "error": made.manifest["error"],
            "manifest": (!self.measure).then(|| set.manifest().display().to_string()),
        });
        if !self.measure {
            set.write(made)?;
        }
        Ok(told)
    }
}
