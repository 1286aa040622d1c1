//! `nbrdf decode`: a code as the network it stands for.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::nbrdf::file;
use serde_json::json;

use super::{Global, of_code};
use crate::failure::Failure;
use crate::material::{STDIN, Sources};
use crate::measure::guard;
use crate::{output, report};

/// Turns a code into a network's file.
#[derive(Debug, Args)]
pub struct Decode {
    /// File of a code; `-` for standard input.
    code: String,
    /// File of the network: .npz, .safetensors, or .npy for a set of six.
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    sources: Sources,
}

impl Decode {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &output::NETWORKS)?;
        let shelf = self.sources.open()?;
        let item = shelf.code(&self.code)?;
        shelf.catalog.check_used()?;
        let name = &item.material.name;
        global.warn_of(name, of_code(&item, &shelf)?)?;
        let model = item.code.as_ref().map_or("", |code| code.model.as_str());
        let Some(network) = &item.material.network else {
            let code = if self.code == STDIN { "CODE" } else { &self.code };
            return Err(Failure::Usage(format!(
                "a code of {model} stands for a table, not for a network: `nbrdf render {code}` shows it; \
                 `nbrdf encode --with znbrdf` makes codes that decode to networks"
            ))
            .into());
        };
        let brdf = item.material.brdf.as_ref();
        global.warn_of(name, guard::of_result(brdf))?;
        file::write(&self.output, network).with_context(|| format!("{}: cannot be written", self.output.display()))?;
        let summary = json!({
            "schema": 1, "material": item.material.name, "model": model, "hidden": network.hidden(),
            "weights": network.weights().len(), "output": self.output.display().to_string(),
        });
        report::print(global, &summary, || format!("{} in {}\n", item.material.name, self.output.display()))
    }
}
