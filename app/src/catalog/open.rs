//! Catalogs for each purpose: what their entries learn from, and which checkpoint or basis they use.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::representation::basis::{BasisFile, Opened};
use nbrdf_core::{Library, Material};

use super::held::Held;
use super::once::Once;
use super::{BasisSize, Catalog, Reference};
use crate::failure::Failure;
use crate::input;

impl Catalog {
    /// Bases are learned from the training materials among these.
    pub const fn new(reference: Arc<Reference>) -> Self {
        Self {
            reference,
            checkpoint: None,
            held: None,
            given: None,
            size: BasisSize { numbers: None, grid: None },
            validate: false,
            learned: Once::new(),
        }
    }

    /// For learning bases of this size, from the training materials of a library if one is given.
    pub fn for_learning(library: Option<Library>, size: BasisSize) -> Self {
        let given = library.map(|library| library.materials());
        Self { given, size, ..Self::new(Arc::new(Reference::built_in())) }
    }

    /// For learning from the training materials among these, measured against the same reference.
    pub fn learning_from(&self, given: Vec<Material>) -> Self {
        Self { given: Some(given), ..Self::new(Arc::clone(&self.reference)) }
    }

    /// For measuring: against this library or the default reference, with this checkpoint or the built-in one.
    pub fn for_measuring(reference: Option<&Path>, checkpoint: Option<&Path>) -> Result<Self> {
        let catalog = Self::new(Arc::new(Reference::load(reference)?));
        match checkpoint {
            Some(path) => catalog.with_checkpoint(path),
            None => Ok(catalog),
        }
    }

    /// With another ZNBRDF checkpoint than the built-in one, or with a basis that was learned before.
    pub fn with_checkpoint(self, path: &Path) -> Result<Self> {
        input::check_file(path, input::CHECKPOINT)?;
        let name = path.display().to_string();
        let bytes = match BasisFile::open(path)? {
            Opened::Other(bytes) => bytes,
            Opened::Basis(basis) if Self::learned_entries().any(|entry| entry.name == basis.name()) => {
                return Ok(Self { held: Some(Held::new(name, basis)), ..self });
            }
            Opened::Basis(basis) => {
                let found = format!("{name}: expected a basis that is known here, found '{}'", basis.name());
                return Err(Failure::InvalidFile(format!("{found}: learn it again with `nbrdf learn`")).into());
            }
        };
        let loaded = Autoencoder::parse(&name, &bytes)?;
        if loaded.architecture() != Architecture::Znbrdf {
            let found = loaded.architecture().name();
            return Err(Failure::InvalidFile(format!("{name}: expected znbrdf, found {found}")).into());
        }
        Ok(Self { checkpoint: Some(Arc::new(loaded)), ..self })
    }

    /// With bases that have not seen the validation materials either.
    ///
    /// # Errors
    /// A usage error where a basis was named that has.
    pub fn without_validation(self) -> Result<Self> {
        if let Some(held) = self.held.as_ref().filter(|held| !held.file.is_without_validation()) {
            let found = format!("{} was learned from the validation materials too", held.path);
            return Err(Failure::Usage(format!("{found}: learn it with --validate")).into());
        }
        Ok(Self { validate: true, ..self })
    }

    /// Refuses a basis that was named and that nothing has asked for.
    pub fn check_used(&self) -> Result<()> {
        match self.held.as_ref().filter(|held| !held.is_used()) {
            Some(held) => {
                let (path, name) = (&held.path, held.file.name());
                Err(Failure::Usage(format!("{path} is a basis of {name}, which is not asked for here: leave it out"))
                    .into())
            }
            None => Ok(()),
        }
    }
}
