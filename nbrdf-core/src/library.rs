//! Named materials: built in, a folder, an archive, a file.
//!
//! Our own form is a folder: `library.safetensors` holds one row of f32 per material (and `@shared_start`, the initial
//! network they were all fitted from, where there is one), `manifest.json` says what they are, from what, by which
//! command, with which seed and error. Published forms are read as they are: archives and folders of `.h5`, `.npz`,
//! `.safetensors` and six-`.npy` sets, or one such file.

pub mod builtin;
mod error;
mod folder;
mod manifest;
pub mod refit;
mod scan;
mod unknown;
mod zip;

use std::{collections::BTreeMap, path::Path};

use crate::{Database, Material, Nbrdf, Split};

pub use error::LibraryError;
pub use manifest::{Provenance, Source};
pub use scan::{Scanned, is_name, scan, scan_archive};
pub use unknown::UnknownMaterial;

/// Longest name of a material \[bytes\].
pub const MAX_NAME: usize = 128;
/// Most materials read from one place.
pub const MAX_ENTRIES: usize = 10_000;

/// A material of a library.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name (`chrome`, `rgl/paper_white`).
    pub name: String,
    /// Where its measurements come from.
    pub database: Database,
    /// Whether it is kept from everything learned.
    pub held_out: bool,
    /// File the network was read or fitted from.
    pub source_file: String,
    /// What its fit costs, by metric (`log_error`, `studio_psnr`, ...); empty for a network as published.
    pub error: BTreeMap<String, f64>,
    /// The network.
    pub network: Nbrdf,
}

impl Entry {
    /// A network as read; database and split follow from the name.
    pub fn new(name: impl Into<String>, source_file: impl Into<String>, network: Nbrdf) -> Self {
        let name = name.into();
        Self {
            database: Database::of(&name),
            held_out: Split::of(&name) == Split::HeldOut,
            source_file: source_file.into(),
            error: BTreeMap::new(),
            network,
            name,
        }
    }

    /// What the tools pass around.
    pub fn material(&self) -> Material {
        Material::from_network(&self.name, self.network.clone())
    }
}

/// An ordered list of named networks, no name twice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    provenance: Provenance,
    shared_start: Option<Nbrdf>,
    entries: Vec<Entry>,
}

impl Library {
    /// A library of these materials, in this order.
    ///
    /// # Errors
    /// [`LibraryError::Entry`] if a name is there twice or cannot name a material.
    pub fn new(provenance: Provenance, shared_start: Option<Nbrdf>, entries: Vec<Entry>) -> Result<Self, LibraryError> {
        scan::check_names(&entries)?;
        Ok(Self { provenance, shared_start, entries })
    }

    /// Opens a library: a folder of ours, an archive or folder of published networks, or one network's file.
    /// Published networks are ordered by database and name.
    ///
    /// # Errors
    /// [`LibraryError`] at the first file that is no readable network; [`scan`] goes on instead.
    pub fn load(path: &Path) -> Result<Self, LibraryError> {
        if let Some(folder) = folder::of_library(path) {
            return folder::load(&folder);
        }
        let entries = scan(path)?.into_iter().map(|scanned| scanned.entry).collect::<Result<Vec<_>, _>>()?;
        let title = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        Self::new(Provenance { title, ..Provenance::default() }, None, entries)
    }

    /// A library of ours from the bytes of its two files.
    ///
    /// # Errors
    /// [`LibraryError`] if either is damaged or they do not belong together.
    pub fn from_bytes(tensors: &[u8], manifest: &[u8]) -> Result<Self, LibraryError> {
        manifest::from_bytes(tensors, manifest)
    }

    /// Whether [`save`](Self::save) into this folder would replace nothing but a library: to be asked before long work.
    ///
    /// # Errors
    /// [`LibraryError::Foreign`] if there is a `manifest.json` or a `library.safetensors` of something else, or of a library
    /// that cannot be read.
    pub fn check_folder(folder: &Path) -> Result<(), LibraryError> {
        folder::check(folder)
    }

    /// Writes our form into a folder, which is made if need be. A library already there is replaced as a whole, or,
    /// when that fails, left as it was.
    ///
    /// # Errors
    /// [`LibraryError`] if a number in an error map is not finite, or the file system says no.
    pub fn save(&self, folder: &Path) -> Result<(), LibraryError> {
        folder::save(self, folder)
    }

    /// The material of this name.
    ///
    /// # Errors
    /// [`UnknownMaterial`] with the names that come nearest.
    pub fn get(&self, name: &str) -> Result<&Entry, UnknownMaterial> {
        self.iter().find(|entry| entry.name == name).ok_or_else(|| unknown::unknown(self, name))
    }

    /// All materials, in order.
    pub fn iter(&self) -> std::slice::Iter<'_, Entry> {
        self.entries.iter()
    }

    /// All materials, moved out, in order.
    pub fn into_entries(self) -> Vec<Entry> {
        self.entries
    }

    /// Number of materials.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is no material.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// All materials as the tools pass them around, in order.
    pub fn materials(&self) -> Vec<Material> {
        self.iter().map(Entry::material).collect()
    }

    /// The one initial network all were fitted from, where there is one.
    pub const fn shared_start(&self) -> Option<&Nbrdf> {
        self.shared_start.as_ref()
    }

    /// What the library was made from, and how.
    pub const fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

impl<'a> IntoIterator for &'a Library {
    type Item = &'a Entry;
    type IntoIter = std::slice::Iter<'a, Entry>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

#[cfg(test)]
mod tests;
