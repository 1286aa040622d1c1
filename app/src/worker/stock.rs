//! What the threads work with: materials, and ways to walk between them.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::{Interpolation, Material};

use crate::catalog::{Catalog, Reference};

type Interpolations = dyn Fn(&str) -> Result<Box<dyn Interpolation>> + Send + Sync;

/// Materials, and interpolations by name.
pub struct Stock {
    /// The materials, in the order of the list.
    pub materials: Vec<Material>,
    /// Makes an interpolation; may take a while.
    pub interpolation: Box<Interpolations>,
}

impl Stock {
    /// The built-in library and the catalog.
    pub fn built_in() -> Self {
        let reference = Arc::new(Reference::built_in());
        let materials = reference.materials.clone();
        let catalog = Catalog::new(reference);
        Self { materials, interpolation: Box::new(move |name| catalog.interpolation(name)) }
    }
}
