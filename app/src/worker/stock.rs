//! What the threads work with: materials, ways to walk between them, and where files come from.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::{Interpolation, Material};

use super::{Cache, dialog};
use crate::catalog::{Catalog, Reference};
use crate::editor::Editor;

type Interpolations = dyn Fn(&str) -> Result<Box<dyn Interpolation>> + Send + Sync;
type Editors = dyn Fn() -> Result<Editor> + Send + Sync;
type Dialog = dyn Fn() -> Result<Vec<PathBuf>, String> + Send + Sync;

/// Steps of a fit to a measured file, as on the command line.
const FIT_STEPS: usize = 30_000;

/// Materials, and interpolations by name.
pub struct Stock {
    /// The materials, in the order of the list.
    pub materials: Vec<Material>,
    /// Makes an interpolation; may take a while.
    pub interpolation: Box<Interpolations>,
    /// What else is learned and known of materials.
    pub catalog: Arc<Catalog>,
    /// Makes what edits qualities.
    pub editor: Box<Editors>,
    /// Steps of a fit to a measured file.
    pub fit_steps: usize,
    /// Where thumbnails, properties and fits are kept between two starts; nowhere, unless it is set.
    pub cache: Cache,
    /// Asks the user for files and waits for the answer: none where the user gives none, or why nobody can be asked.
    pub dialog: Box<Dialog>,
}

impl Stock {
    /// The built-in library and the catalog.
    pub fn built_in() -> Self {
        let reference = Arc::new(Reference::built_in());
        let materials = reference.materials.clone();
        let catalog = Arc::new(Catalog::new(reference));
        let [for_paths, for_editor] = [Arc::clone(&catalog), Arc::clone(&catalog)];
        Self {
            materials,
            interpolation: Box::new(move |name| for_paths.interpolation(name)),
            editor: Box::new(move || Editor::of(&for_editor)),
            catalog,
            fit_steps: FIT_STEPS,
            cache: Cache::default(),
            dialog: Box::new(dialog::native),
        }
    }
}
