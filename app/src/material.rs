//! What a MATERIAL, FILE or CODE on the command line stands for.

mod code_file;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::library::{Entry, builtin, is_name};
use nbrdf_core::measured::{self, Measured, is_measured};
use nbrdf_core::metric::{albedo_max, albedo_max_around};
use nbrdf_core::nbrdf::file::read_anisotropic;
use nbrdf_core::{Code, Library, Material, Split};

pub use code_file::{MAX_NUMBERS, STDIN, parse_code, read_code};

use crate::catalog::{Catalog, Reference};
use crate::failure::Failure;
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
}

/// Opened sources.
pub struct Shelf {
    library: Option<Library>,
    /// Everything by name, with the checkpoint asked for.
    pub catalog: Arc<Catalog>,
}

/// A material, and where it comes from.
pub struct Item {
    /// The reflectance, and the network where there is one.
    pub material: Material,
    /// Its line in a library.
    pub entry: Option<Entry>,
    /// Its code, if a code was named.
    pub code: Option<Code>,
    /// Whether it changes when it is turned: then it has no code, and figures of one azimuth say little of it.
    turns: bool,
}

impl Sources {
    /// Reads what was named.
    pub fn open(&self) -> Result<Shelf> {
        // Bases are learned from what the binary carries: a code means the same on every machine.
        let catalog = Catalog::new(Arc::new(Reference::built_in()));
        let catalog = match &self.checkpoint {
            Some(path) => catalog.with_checkpoint(path)?,
            None => catalog,
        };
        Ok(Shelf::new(self.library.as_deref().map(Library::load).transpose()?, Arc::new(catalog)))
    }
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
        self.any_material(argument)?.isotropic(argument)
    }

    fn any_material(&self, argument: &str) -> Result<Item> {
        match self.library().get(argument) {
            Ok(entry) => Ok(Item::of_entry(entry.clone())),
            Err(_) if argument == STDIN => {
                Err(Failure::Usage("a code cannot stand here: decode it first".into()).into())
            }
            Err(_) if means_a_file(argument) => network_in(Path::new(argument)),
            Err(unknown) => Err(unknown.into()),
        }
    }

    /// A name in the library, the file of a network, or a code.
    pub fn material_or_code(&self, argument: &str) -> Result<Item> {
        self.any(argument)?.isotropic(argument)
    }

    /// The same, or a material that changes when it is turned: to be looked at.
    pub fn any(&self, argument: &str) -> Result<Item> {
        if self.library().get(argument).is_err() && code_file::means_a_code(argument) {
            return self.code(argument);
        }
        self.any_material(argument)
    }

    /// A code's file, or standard input for `-`, decoded by the model it names.
    pub fn code(&self, argument: &str) -> Result<Item> {
        decoded(&self.catalog, read_code(argument)?, &code_file::shown(argument))
    }
}

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
    Ok(Item { material, entry: None, code: Some(code), turns: false })
}

impl Item {
    fn of_entry(entry: Entry) -> Self {
        Self { material: entry.material(), entry: Some(entry), code: None, turns: false }
    }

    fn of_file(material: Material, turns: bool) -> Self {
        Self { material, entry: None, code: None, turns }
    }

    /// Itself, if it is the same however it is turned.
    fn isotropic(self, argument: &str) -> Result<Self> {
        if self.turns {
            return Err(Failure::InvalidFile(format!(
                "{argument}: expected an isotropic material, found one that changes when it is turned: a table of such a \
                 material is fitted by `nbrdf fit`, table and network are shown by `nbrdf render`; it has no code"
            ))
            .into());
        }
        Ok(self)
    }

    /// Largest albedo: of viewers all around where it changes when it is turned.
    pub fn albedo_max(&self) -> f64 {
        match self.turns {
            true => albedo_max_around(self.material.brdf.as_ref()),
            false => albedo_max(self.material.brdf.as_ref()),
        }
    }

    /// The split it belongs to; none for what is in no standard database.
    pub fn split(&self) -> Option<Split> {
        split_of(&self.material.name)
    }
}

/// The split of a material of a standard database; splits say nothing about others.
pub fn split_of(name: &str) -> Option<Split> {
    let standard = nbrdf_core::Database::of(name).names().binary_search(&name).is_ok();
    standard.then(|| Split::of(name))
}

/// Refuses a file whose name makes no material's name.
fn check_name(path: &Path) -> Result<()> {
    if !is_name(&measured::name_of(path)) {
        let path = path.display();
        return Err(Failure::InvalidFile(format!("{path}: expected a printable name: rename the file")).into());
    }
    Ok(())
}

/// A measured table is a material; a list of samples is none yet.
fn measured_in(path: &Path) -> Result<Item> {
    check_name(path)?;
    match Measured::load(path)? {
        Measured::Everywhere(table) => Ok(Item::of_file(measured::material(path, table), false)),
        Measured::Turning(table) => Ok(Item::of_file(measured::material(path, table), true)),
        Measured::Somewhere(_) => {
            let path = path.display();
            let found = format!(
                "{path} holds samples at some directions: `nbrdf fit {path} -o NETWORK.npz` makes a material of them"
            );
            Err(Failure::Usage(found).into())
        }
    }
}

/// A path, rather than a misspelt name.
fn means_a_file(argument: &str) -> bool {
    const FORMS: [&str; 7] = ["h5", "hdf5", "npz", "npy", "safetensors", "json", "zip"];
    let path = Path::new(argument);
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let by_extension = FORMS.iter().any(|form| extension.eq_ignore_ascii_case(form));
    by_extension
        || is_measured(path)
        || path.is_absolute()
        || argument.starts_with("./")
        || argument.starts_with("../")
        || path.exists()
}

fn network_in(path: &Path) -> Result<Item> {
    if is_measured(path) {
        return measured_in(path);
    }
    if !path.exists() {
        let found = format!("{}: expected the file of a network, found no such file", path.display());
        return Err(Failure::InvalidFile(format!("{found}: check the path; `nbrdf list` names the materials")).into());
    }
    if let Some(network) = read_anisotropic(path)? {
        check_name(path)?;
        return Ok(Item::of_file(measured::material(path, Arc::new(network)), true));
    }
    let mut entries = Library::load(path)?.into_entries();
    match (entries.pop(), entries.len()) {
        (Some(entry), 0) => Ok(Item::of_entry(entry)),
        (_, others) => {
            let path = path.display();
            let found = format!("{path} holds {} materials: name one of them, with --library {path}", others + 1);
            Err(Failure::Usage(found).into())
        }
    }
}
