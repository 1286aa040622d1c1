//! `nbrdf decode`: a code as the network or the table it stands for.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use nbrdf_core::Nbrdf;
use serde_json::json;

use super::{Global, of_code};
use crate::catalog::exporters::{EXPORTERS, ExporterEntry, Needs, Subject};
use crate::failure::Failure;
use crate::material::{STDIN, Sources};
use crate::measure::guard;
use crate::{output, report};

/// Turns a code into the file of a network, or of a table.
#[derive(Debug, Args)]
pub struct Decode {
    /// File of a code; `-` for standard input.
    code: String,
    /// File to write: a network as .npz, .safetensors, .h5, or .npy for a set of six; a table as .binary or .bsdf.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    sources: Sources,
}

impl Decode {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let forms = || EXPORTERS.iter().filter(|entry| entry.needs != Needs::Code);
        output::check(&self.output, &forms().map(|entry| entry.extension).collect::<Vec<_>>())?;
        let Some(form) = ExporterEntry::of(&self.output) else {
            let known: Vec<_> = forms().map(|entry| format!(".{}", entry.extension)).collect();
            let path = self.output.display();
            return Err(Failure::Usage(format!("{path}: expected the extension {}", known.join(" or "))).into());
        };
        let stem = self.output.with_extension("");
        for path in form.paths(&stem) {
            output::check_no_input(&path, std::slice::from_ref(&self.code))?;
            if path.extension() != self.output.extension() {
                output::check_no_code(&path)?;
            }
        }
        let shelf = self.sources.open()?;
        let item = shelf.code(&self.code)?;
        shelf.catalog.check_used()?;
        let name = &item.material.name;
        global.warn_of(name, of_code(&item, &shelf)?)?;
        let model = item.code.as_ref().map_or("", |code| code.model.as_str());
        let subject = Subject { material: &item.material, code: item.code.as_ref() };
        let network = subject.network();
        if network.is_none() && form.needs == Needs::Network {
            let code = if self.code == STDIN { "CODE" } else { &self.code };
            return Err(Failure::Usage(format!(
                "a code of {model} stands for a table, not for a network: `nbrdf render {code}` shows it, -o OUT.binary \
                 writes it; `nbrdf encode --with znbrdf` makes codes that decode to networks"
            ))
            .into());
        }
        let brdf = item.material.brdf.as_ref();
        global.warn_of(name, guard::of_result(brdf))?;
        form.write(&self.output, &subject)?;
        let summary = json!({
            "schema": 1, "material": item.material.name, "model": model, "hidden": network.map(Nbrdf::hidden),
            "weights": network.map(|network| network.weights().len()), "output": self.output.display().to_string(),
        });
        report::print(global, &summary, || format!("{} in {}\n", item.material.name, self.output.display()))
    }
}
