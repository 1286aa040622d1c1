//! `nbrdf export`: materials in the forms that other programs read.

mod destination;
mod listed;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::atomic;
use serde_json::{Value, json};

use super::{Global, of_code};
use crate::catalog::ExporterEntry;
use crate::catalog::exporters::Subject;
use crate::exported;
use crate::failure::Failure;
use crate::material::{Item, Shelf, Sources};
use crate::measure::guard;
use crate::shell::quoted;
use crate::{output, progress, report};
use destination::Destination;

/// Writes materials in a form that other programs read, each with a manifest: what it is of, what its numbers mean, and how
/// far it is from its source.
#[derive(Debug, Args)]
pub struct Export {
    /// Names of materials, files of networks or measurements, or codes (one may be `-` for standard input).
    #[arg(value_name = "MATERIAL|CODE|FILE", required_unless_present = "list")]
    materials: Vec<String>,
    /// The form; that of OUT's extension by default.
    #[arg(long, value_name = "FORM")]
    to: Option<String>,
    /// File to write, whose extension may be left out; a folder for several materials.
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
        to.make_folder()?;
        let stems = to.stems(items.iter().map(|item| item.material.name.as_str()))?;
        for stem in &stems {
            to.files(stem).iter().try_for_each(|path| self.check(path, to.form))?;
        }
        let bar = progress::bar(items.len() as u64, to.form.name, global.quiet);
        let mut exports = Vec::new();
        for ((argument, item), stem) in self.materials.iter().zip(&items).zip(&stems) {
            progress::check()?;
            bar.set_message(item.material.name.clone());
            let command = self.command(argument, to.form, stem);
            exports.push(self.export(item, &to, stem, &shelf, global, &command)?);
            bar.inc(1);
        }
        bar.finish_and_clear();
        let summary = json!({"schema": 1, "form": to.form.name, "exports": exports});
        report::print(global, &summary, || exports.iter().map(line).collect())
    }

    /// What is to be written, all of it known before any is.
    fn items(&self, shelf: &Shelf, form: &ExporterEntry, global: &Global) -> Result<Vec<Item>> {
        let item = |argument: &String| -> Result<Item> {
            let item = shelf.any(argument)?;
            let subject = Subject { material: &item.material, code: item.code.as_ref() };
            form.check(&subject).map_err(|error| Failure::Usage(format!("{error:#}")))?;
            let brdf = item.material.brdf.as_ref();
            let energy = guard::of_energy(item.albedo_max());
            let told = of_code(&item, shelf)?.into_iter().chain(energy).chain(guard::of_use(brdf));
            global.warn_of(&item.material.name, told)?;
            Ok(item)
        };
        self.materials.iter().map(item).collect()
    }

    /// Refuses to write over what is read, and where nothing can be written.
    fn check(&self, path: &Path, form: &ExporterEntry) -> Result<()> {
        if self.measure {
            return Ok(());
        }
        output::check_no_input(path, &self.materials)?;
        if path.extension().is_none_or(|extension| extension != form.extension) {
            output::check_no_code(path)?;
        }
        output::check_writable(path)
    }

    /// What makes the files of one material again.
    fn command(&self, argument: &str, form: &ExporterEntry, stem: &Path) -> String {
        let output = format!("{} -o {}", form.name, quoted(&stem.to_string_lossy()));
        format!("nbrdf export {} --to {output}{}", quoted(argument), self.sources.options())
    }

    /// Writes one material, unless it is only measured; what is told of it.
    fn export(
        &self,
        item: &Item,
        to: &Destination,
        stem: &Path,
        shelf: &Shelf,
        global: &Global,
        command: &str,
    ) -> Result<Value> {
        let subject = Subject { material: &item.material, code: item.code.as_ref() };
        let refused = |error: anyhow::Error| Failure::Usage(format!("{error:#}"));
        let files = to.form.files(stem, &subject).map_err(refused)?;
        let manifest = exported::manifest(to.form, &subject, &files, &shelf.catalog, command)?;
        if let Some(told) = exported::warning(to.form, &manifest["error"]) {
            global.warn(format_args!("{}: {told}", item.material.name))?;
        }
        let told = json!({
            "material": item.material.name, "files": manifest["files"], "error": manifest["error"],
            "manifest": (!self.measure).then(|| to.manifest(stem).display().to_string()),
        });
        if !self.measure {
            let text = format!("{manifest:#}\n").into_bytes();
            let all: Vec<_> = std::iter::once((to.manifest(stem), text)).chain(files).collect();
            atomic::write_together(&all).with_context(|| format!("{}: cannot be written", stem.display()))?;
        }
        Ok(told)
    }
}

fn line(export: &Value) -> String {
    let files = export["files"].as_array().map_or(&[][..], Vec::as_slice);
    let names: Vec<&str> = files.iter().filter_map(|file| file["name"].as_str()).collect();
    let bytes: u64 = files.iter().filter_map(|file| file["bytes"].as_u64()).sum();
    let error = &export["error"];
    let figure = |key: &str| report::figure(error[key].as_f64().unwrap_or(f64::NAN));
    let how = format!("log_error {}, studio PSNR {} dB", figure("log_error"), figure("studio_psnr"));
    let name = export["material"].as_str().unwrap_or_default();
    format!("{name} in {}, {:.1} kB; {how}\n", names.join(", "), bytes as f64 / 1e3)
}
