//! What the entries of the list share: reference materials, checkpoint, what was learned.

use std::path::Path;
use std::sync::Arc;

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::representation::basis::{BasisFile, Opened};
use nbrdf_core::representation::grid::Grid;
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::{Database, Interpolation, Library, Material, Representation as _, Split};

use super::held::Held;
use super::once::Once;
use super::twin::{WithNetwork, independent_network};
use super::{
    INTERPOLATIONS, InterpolationEntry, Learned, REPRESENTATIONS, Reference, RepresentationEntry, Shared, Variant,
};
use crate::failure::Failure;

/// The list, together with what its entries learn from; costly parts are learned once, when first asked for.
pub struct Catalog {
    reference: Arc<Reference>,
    checkpoint: Option<Arc<Autoencoder>>,
    /// What was learned before, of one representation.
    pub(super) held: Option<Held>,
    /// Learn from these in place of the reference materials.
    pub(super) given: Option<Vec<Material>>,
    pub(super) size: BasisSize,
    /// Whether bases leave out the validation materials.
    validate: bool,
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

/// The failure of a name that is none of those known.
pub fn unknown(what: &str, name: &str, known: impl Iterator<Item = &'static str>) -> anyhow::Error {
    let mut names: Vec<&str> = known.collect();
    names.dedup();
    let nearest = names.iter().max_by(|a, b| strsim::jaro(a, name).total_cmp(&strsim::jaro(b, name)));
    let nearest = nearest.copied().unwrap_or_default();
    Failure::Usage(format!("no {what} '{name}': did you mean '{nearest}'? There are {}", names.join(", "))).into()
}
