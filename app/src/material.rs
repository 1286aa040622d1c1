//! What a MATERIAL, FILE or CODE on the command line stands for.

mod code_file;
mod files;
mod item;
mod shelf;
mod sources;

use std::sync::Arc;

use anyhow::{Context, Result};
use nbrdf_core::{Code, Material, Split};

pub use code_file::{MAX_NUMBERS, STDIN, parse_code, read_code};
pub use item::Item;
pub use shelf::Shelf;
pub use sources::Sources;

use crate::catalog::Catalog;
use crate::failure::Failure;

/// What a code that came from `file` stands for, by the model it names.
///
/// # Errors
/// If it is one of an unknown model, or one that its model refuses.
pub fn decoded(catalog: &Catalog, code: Code, file: &str) -> Result<Item> {
    let representation = catalog.representation(&code.model, false).map_err(|error| {
        Failure::InvalidFile(format!("{file}: expected the code of a model that is known here: {error}"))
    })?;
    let network = representation.network(&code).with_context(|| file.to_owned())?;
    let name = code.material.clone().unwrap_or_else(|| "code".to_owned());
    let material = match network {
        Some(network) => Material::from_network(name, network),
        None => Material::new(name, Arc::from(representation.decode(&code).with_context(|| file.to_owned())?)),
    };
    Ok(Item::of_code(material, code))
}

/// The split of a material of a standard database; splits say nothing about others.
pub fn split_of(name: &str) -> Option<Split> {
    let standard = nbrdf_core::Database::of(name).names().binary_search(&name).is_ok();
    standard.then(|| Split::of(name))
}
