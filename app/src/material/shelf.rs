//! Names, files and codes, looked up.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::library::builtin;
use nbrdf_core::{Code, Library};

use super::code_file::{means_a_code, read_code, shown};
use super::files::{item_in, means_a_file, missing};
use super::{Item, STDIN, decoded};
use crate::catalog::Catalog;
use crate::failure::Failure;
use crate::input::is_missing;
use crate::shell::quoted;

/// Opened sources.
pub struct Shelf {
    library: Option<Library>,
    /// Everything by name, with the checkpoint asked for.
    pub catalog: Arc<Catalog>,
}

impl Shelf {
    /// Names of this library, or of the built-in one.
    pub const fn new(library: Option<Library>, catalog: Arc<Catalog>) -> Self {
        Self { library, catalog }
    }

    /// The library that names refer to.
    pub fn library(&self) -> &Library {
        self.library.as_ref().unwrap_or_else(|| builtin::shared())
    }

    /// A name in the library, or the file of a network or measurement.
    pub fn material(&self, argument: &str) -> Result<Item> {
        if self.names_a_code(argument) && (argument == STDIN || !is_missing(Path::new(argument))) {
            let (code, word) = (shown(argument), quoted(argument));
            let said = format!(
                "{code}: expected a material, found a code: `nbrdf decode {word} -o OUT.npz` makes a network of it"
            );
            return Err(Failure::Usage(said).into());
        }
        self.any_material(argument)?.isotropic(argument)
    }

    fn any_material(&self, argument: &str) -> Result<Item> {
        let unknown = match self.library().get(argument) {
            Ok(entry) => return Ok(Item::of_entry(entry.clone())),
            Err(unknown) => unknown,
        };
        let path = Path::new(argument);
        if means_a_file(argument) {
            return item_in(path, &unknown.suggestions);
        }
        // `merl/chrome` is a wrong name rather than a missing file.
        match argument.contains('/') && unknown.suggestions.is_empty() {
            true => Err(missing(path, &[]).into()),
            false => Err(unknown.into()),
        }
    }

    /// A name in the library, the file of a network, or a code.
    pub fn material_or_code(&self, argument: &str) -> Result<Item> {
        self.any(argument)?.isotropic(argument)
    }

    /// The same, or a material that changes when it is turned: to be looked at.
    pub fn any(&self, argument: &str) -> Result<Item> {
        match self.names_a_code(argument) {
            true => self.decoded(read_code(argument)?, argument),
            false => self.any_material(argument),
        }
    }

    /// A code's file, or standard input for `-`, decoded by the model it names.
    pub fn code(&self, argument: &str) -> Result<Item> {
        if argument != STDIN && is_missing(Path::new(argument)) && self.library().get(argument).is_ok() {
            let name = quoted(argument);
            let said = format!("{argument}: expected a code, found a material: `nbrdf encode {name}` makes its code");
            return Err(Failure::Usage(said).into());
        }
        self.decoded(read_code(argument)?, argument)
    }

    fn decoded(&self, code: Code, argument: &str) -> Result<Item> {
        decoded(&self.catalog, code, &shown(argument))
    }

    fn names_a_code(&self, argument: &str) -> bool {
        means_a_code(argument) && self.library().get(argument).is_err()
    }
}
