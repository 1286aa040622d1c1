//! `nbrdf encode`: a material as a few numbers.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::{Code, atomic};

use super::{Global, names};
use crate::catalog::Catalog;
use crate::failure::Failure;
use crate::material::{MAX_NUMBERS, Sources};
use crate::measure::{Trust, guard};
use crate::{output, report};

/// Turns a material into a code, written as JSON.
#[derive(Debug, Args)]
pub struct Encode {
    /// Name of a material, or the file of a network or measurement.
    #[arg(value_name = "MATERIAL|FILE")]
    material: String,
    /// Refine the code against the material itself: closer, and a second or so slower.
    #[arg(long)]
    refine: bool,
    /// Representation that makes the code; that of the checkpoint by default, else znbrdf.
    #[arg(long = "with", value_name = "NAME", value_parser = names::representations())]
    representation: Option<String>,
    #[command(flatten)]
    sources: Sources,
    /// File of the code; standard output by default.
    #[arg(short, long, value_name = "CODE")]
    output: Option<PathBuf>,
}

impl Encode {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let output = self.output.as_deref().filter(|path| path.as_os_str() != "-");
        if let Some(path) = output {
            output::check(path, &["json"])?;
        }
        let shelf = self.sources.open()?;
        let item = shelf.material(&self.material)?;
        let name = self.name(&shelf.catalog)?;
        let representation = shelf.catalog.representation(name, self.refine)?;
        if representation.dim() > MAX_NUMBERS {
            let dim = representation.dim();
            return Err(Failure::Usage(format!(
                "a code of {name} has {dim} numbers, and a file of a code holds {MAX_NUMBERS} at most: keep the table \
                 itself"
            ))
            .into());
        }
        let code = representation.encode(&item.material)?;
        let decoded = representation.decode(&code)?;
        let trust = Trust::of(&item.material, &code, decoded.as_ref(), &shelf.catalog.autoencoder())?;
        let can_refine = !self.refine && Catalog::has_refined_form(name);
        if let Some(advice) = trust.advice(&item.material.name, can_refine) {
            global.warn(format_args!("{advice}"))?;
        }
        let source = guard::of_source(item.material.brdf.as_ref());
        let distance = guard::of_distance(&code, &shelf.catalog.autoencoder())?;
        let told = source.chain(distance).chain(guard::of_result(decoded.as_ref()));
        global.warn_of(&item.material.name, told)?;
        let code = Code {
            material: Some(item.material.name),
            expected_log_error: Some(trust.expected_log_error),
            distance: trust.distance,
            ..code
        };
        let json = serde_json::to_string(&code)? + "\n";
        if let Some(path) = output {
            atomic::write(path, json.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))?;
        }
        match output.is_none() || global.json {
            true => report::write(&json),
            false => Ok(()),
        }
    }

    /// The representation asked for, or that of the checkpoint; not another one than that.
    fn name<'a>(&'a self, catalog: &'a Catalog) -> Result<&'a str> {
        match (self.representation.as_deref(), catalog.checkpoint_of()) {
            (Some(asked), Some(held)) if asked != held => Err(Failure::Usage(format!(
                "the checkpoint is of {held}, not of {asked}: leave out --with, or name another file"
            ))
            .into()),
            (asked, held) => Ok(asked.or(held).unwrap_or("znbrdf")),
        }
    }
}
