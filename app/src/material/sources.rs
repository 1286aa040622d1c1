//! Where names and codes are looked up.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Result;
use clap::Args;

use super::Shelf;
use crate::catalog::{Catalog, Reference};
use crate::input;
use crate::shell::quoted;

/// Where names and codes are looked up.
#[derive(Debug, Clone, Args)]
pub struct Sources {
    /// Library whose names are meant: a folder or an archive; the built-in one by default.
    #[arg(long, value_name = "PATH")]
    library: Option<PathBuf>,
    /// ZNBRDF checkpoint to use in place of the built-in one, or a basis of `nbrdf learn`.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Option<PathBuf>,
}

impl Sources {
    /// The options that were given, as a command line has them after its arguments.
    pub fn options(&self) -> String {
        let given = [("library", &self.library), ("checkpoint", &self.checkpoint)];
        let option = |(name, path): (&str, &Option<PathBuf>)| {
            path.as_ref().map(|path| format!(" --{name} {}", quoted(&path.to_string_lossy())))
        };
        given.into_iter().filter_map(option).collect()
    }

    /// The files that are read: nothing may be written over them.
    pub fn inputs(&self) -> impl Iterator<Item = String> {
        [&self.library, &self.checkpoint].into_iter().flatten().map(|path| path.to_string_lossy().into_owned())
    }

    /// Reads what was named.
    pub fn open(&self) -> Result<Shelf> {
        // Bases are learned from what the binary carries: a code means the same on every machine.
        let catalog = Catalog::new(Arc::new(Reference::built_in()));
        let catalog = match &self.checkpoint {
            Some(path) => catalog.with_checkpoint(path)?,
            None => catalog,
        };
        Ok(Shelf::new(self.library.as_deref().map(input::library).transpose()?, Arc::new(catalog)))
    }
}
