//! `nbrdf learn`: a basis, for codes that travel with it.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use nbrdf_core::representation::grid::Grid;
use serde_json::json;

use super::{Global, names};
use crate::catalog::{BasisSize, Catalog, Learned};
use crate::failure::Failure;
use crate::{input, output, report};

/// Most components over the grid of MERL: 17.5 MB each, in a file of 2 GiB.
const MOST_OVER_MERL: usize = 120;

/// Learns a linear basis, a chart or directions from a library's training materials. `--checkpoint` takes the file
/// wherever codes are made or read.
#[derive(Debug, Args)]
pub struct Learn {
    /// Representation to learn.
    #[arg(value_name = "NAME", value_parser = names::bases())]
    name: String,
    /// Library to learn from; the built-in one by default.
    #[arg(long, value_name = "PATH")]
    library: Option<PathBuf>,
    /// File to write (.safetensors).
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Components of a PCA, coordinates of a chart, or directions of optimal sampling, in place of as many as the name says;
    /// the name stays.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=512))]
    numbers: Option<u16>,
    /// Cells of a PCA's tables: 60 x 40 x 80, or the 90 x 90 x 180 of MERL with 8 times the memory.
    #[arg(long, value_enum)]
    grid: Option<Cells>,
    /// Leave the validation materials out too: for making choices.
    #[arg(long)]
    validate: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Cells {
    Coarse,
    Merl,
}

impl Learn {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &["safetensors"])?;
        self.check(Catalog::learned(&self.name)?)?;
        let library = self.library.as_deref().map(input::library).transpose()?;
        let grid = self.grid.map(|cells| match cells {
            Cells::Coarse => Grid::Coarse,
            Cells::Merl => Grid::Merl,
        });
        let size = BasisSize { numbers: self.numbers.map(usize::from), grid };
        let catalog = Catalog::for_learning(library, size);
        let catalog = if self.validate { catalog.without_validation()? } else { catalog };
        let from = self.library.as_ref().map_or("the built-in library".to_owned(), |path| path.display().to_string());
        let materials = catalog.training_materials().len();
        let about = || format!("learning {} from the {materials} training materials of {from}", self.name);
        let file = catalog.learn(&self.name).with_context(about)?;
        let basis = catalog.representation(&self.name, false)?;
        file.save(&self.output)?;
        let summary = json!({
            "schema": 1, "name": basis.name(), "checkpoint": basis.checkpoint(), "dim": basis.dim(),
            "code_bytes": basis.code_bytes(), "shared_bytes": basis.shared_bytes(), "library": from,
            "materials": materials, "output": self.output.display().to_string(),
        });
        report::print(global, &summary, || {
            let (name, checkpoint, numbers) = (basis.name(), basis.checkpoint(), basis.dim());
            format!("{name} {checkpoint}, codes of {numbers} numbers, in {}\n", self.output.display())
        })
    }

    /// Refuses a size that this representation does not have.
    fn check(&self, learned: Learned) -> Result<()> {
        let name = &self.name;
        let numbers = self.numbers.map_or(0, usize::from);
        let refused = match learned.most_numbers {
            0 if numbers > 0 => format!("{name} has three numbers for every material: leave out --numbers"),
            most if numbers > most => format!("{name} has {most} at most: choose fewer --numbers"),
            _ if self.grid.is_some() && !learned.has_grids => {
                format!("{name} is learned over one grid: leave out --grid")
            }
            _ if self.grid == Some(Cells::Merl) && numbers > MOST_OVER_MERL => {
                format!("over the grid of MERL {name} has {MOST_OVER_MERL} at most, 2 GB: choose fewer --numbers")
            }
            _ => return Ok(()),
        };
        Err(Failure::Usage(refused).into())
    }
}
