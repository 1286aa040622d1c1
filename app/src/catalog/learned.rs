//! What the entries of the list share: reference materials, checkpoint, what was learned.

use std::sync::Arc;

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::representation::basis::BasisFile;
use nbrdf_core::representation::grid::Grid;
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::{Database, Interpolation, Material, Representation as _, Split};

use super::held::Held;
use super::once::Once;
use super::twin::{WithNetwork, independent_network};
use super::unknown::unknown;
use super::{
    INTERPOLATIONS, InterpolationEntry, Learned, REPRESENTATIONS, Reference, RepresentationEntry, Shared, Variant,
};
use crate::failure::Failure;

/// The list, together with what its entries learn from; costly parts are learned once, when first asked for.
pub struct Catalog {
    pub(super) reference: Arc<Reference>,
    pub(super) checkpoint: Option<Arc<Autoencoder>>,
    /// What was learned before, of one representation.
    pub(super) held: Option<Held>,
    /// Learn from these in place of the reference materials.
    pub(super) given: Option<Vec<Material>>,
    pub(super) size: BasisSize,
    /// Whether bases leave out the validation materials.
    pub(super) validate: bool,
    pub(super) learned: Once,
}

/// How large bases are, where they are not as large as their names say.
#[derive(Clone, Copy, Debug, Default)]
pub struct BasisSize {
    /// Numbers of a code: components, coordinates; directions, of three numbers each.
    pub numbers: Option<usize>,
    /// Cells of tables.
    pub grid: Option<Grid>,
}

impl Catalog {
    /// What errors are measured against.
    pub fn reference(&self) -> &Reference {
        &self.reference
    }

    /// Mark of what was learned and is used: that of the checkpoint, and of a basis that was named.
    pub fn mark(&self) -> String {
        let own = self.autoencoder().checkpoint().to_owned();
        match &self.held {
            Some(held) => format!("{own}, {} {}", held.file.name(), held.file.checkpoint()),
            None => own,
        }
    }

    /// The name of what the checkpoint's file holds; none where none was named.
    pub fn checkpoint_of(&self) -> Option<&str> {
        let autoencoder = self.checkpoint.as_ref().map(|_| Architecture::Znbrdf.name());
        autoencoder.or_else(|| self.held.as_ref().map(|held| held.file.name()))
    }

    /// The lines of what is learned, and can be saved.
    pub fn learned_entries() -> impl Iterator<Item = &'static RepresentationEntry> {
        REPRESENTATIONS.iter().filter(|entry| entry.basis.is_some())
    }

    /// What is learned of a representation, and in which sizes.
    pub fn learned(name: &str) -> Result<Learned> {
        let found = Self::learned_entries().find_map(|entry| entry.basis.filter(|_| entry.name == name));
        found.ok_or_else(|| unknown("basis", name, Self::learned_entries().map(|entry| entry.name)))
    }

    /// Learns a basis.
    pub fn learn(&self, name: &str) -> Result<BasisFile> {
        let learned = (Self::learned(name)?.file)(self)?;
        Ok(learned.without_validation(self.validate))
    }

    /// A representation by name; `refined` asks for its refined form.
    pub fn representation(&self, name: &str, refined: bool) -> Result<Shared> {
        let entries = REPRESENTATIONS.iter().filter(|entry| entry.name == name);
        let mut entries = entries.filter(|entry| (entry.variant == Variant::Refined) == refined);
        match entries.next() {
            Some(entry) => entry.build(self),
            None if REPRESENTATIONS.iter().any(|entry| entry.name == name) => {
                Err(Failure::Usage(format!("'{name}' has no refined form")).into())
            }
            None => Err(unknown("representation", name, REPRESENTATIONS.iter().map(|entry| entry.name))),
        }
    }

    /// Whether a representation has a refined form.
    pub fn has_refined_form(name: &str) -> bool {
        REPRESENTATIONS.iter().any(|entry| entry.name == name && entry.variant == Variant::Refined)
    }

    /// An interpolation by name.
    pub fn interpolation(&self, name: &str) -> Result<Box<dyn Interpolation>> {
        Self::interpolation_entry(name)?.build(self)
    }

    /// The line of an interpolation.
    pub fn interpolation_entry(name: &str) -> Result<&'static InterpolationEntry> {
        let found = INTERPOLATIONS.iter().find(|entry| entry.name == name);
        found.ok_or_else(|| unknown("method", name, INTERPOLATIONS.iter().map(|entry| entry.name)))
    }

    pub(super) fn znbrdf(&self) -> Shared {
        Arc::new(Refined::briefly(self.autoencoder()))
    }

    pub(super) fn refined(&self) -> Shared {
        Arc::new(Refined::new(self.autoencoder()))
    }

    /// ZNBRDF itself, which knows more than a representation does.
    pub fn autoencoder(&self) -> Arc<Autoencoder> {
        self.checkpoint.clone().unwrap_or_else(|| Autoencoder::built_in(Architecture::Znbrdf))
    }

    /// The published architecture, handed independently started networks: those it was trained on.
    pub(super) fn published(&self) -> Shared {
        let inner = Autoencoder::built_in(Architecture::Published);
        Arc::new(WithNetwork { inner, source: independent_network })
    }

    /// The materials that may be learned from.
    pub fn training_materials(&self) -> Vec<Material> {
        match &self.given {
            Some(given) => self.training(given),
            None => self.training(&self.reference.materials),
        }
    }

    /// Those that may be learned from: not the RGL materials, which are for testing, nor any that are held out.
    pub(super) fn training(&self, materials: &[Material]) -> Vec<Material> {
        let may_learn =
            |name: &str| Database::of(name) != Database::Rgl && Split::of(name).is_learned_from(self.validate);
        materials.iter().filter(|material| may_learn(&material.name)).cloned().collect()
    }
}
