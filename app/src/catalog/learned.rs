//! What the entries of the list learn from and share: reference materials, checkpoint, bases.

use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use anyhow::Result;
use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::library::builtin;
use nbrdf_core::representation::charting::{Charting, Options, Span};
use nbrdf_core::representation::pca_tables::{PcaOptions, PcaTables};
use nbrdf_core::representation::pca_weights::PcaWeights;
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::{Database, Interpolation, Material, Split};

use super::measured::Measured;
use super::twin::{WithNetwork, independent_network, shared_start_network};
use super::{DIM, INTERPOLATIONS, InterpolationEntry, REPRESENTATIONS, Reference, Shared, Variant};
use crate::failure::Failure;

/// The list, together with what its entries learn from; costly parts are learned once, when first asked for.
pub struct Catalog {
    reference: Arc<Reference>,
    checkpoint: Option<Arc<Autoencoder>>,
    /// Whether bases leave out the validation materials.
    validate: bool,
    /// Bases over tables, one for each name asked for.
    pca: Mutex<Vec<(&'static str, Arc<PcaTables>)>>,
    pca_weights: OnceLock<Arc<WithNetwork<PcaWeights>>>,
    span: OnceLock<Arc<Span>>,
    charting_15: OnceLock<Arc<Charting>>,
    charting_2: OnceLock<Arc<Charting>>,
    pub(super) measured: Measured,
}

impl Catalog {
    /// Bases are learned from the training materials among these.
    pub const fn new(reference: Arc<Reference>) -> Self {
        Self {
            reference,
            checkpoint: None,
            validate: false,
            pca: Mutex::new(Vec::new()),
            pca_weights: OnceLock::new(),
            span: OnceLock::new(),
            charting_15: OnceLock::new(),
            charting_2: OnceLock::new(),
            measured: Measured::new(),
        }
    }

    /// For measuring: against this library or the default reference, with this checkpoint or the built-in one.
    pub fn for_measuring(reference: Option<&Path>, checkpoint: Option<&Path>) -> Result<Self> {
        let catalog = Self::new(Arc::new(Reference::load(reference)?));
        match checkpoint {
            Some(path) => catalog.with_checkpoint(path),
            None => Ok(catalog),
        }
    }

    /// With another ZNBRDF checkpoint than the built-in one.
    pub fn with_checkpoint(self, path: &Path) -> Result<Self> {
        let loaded = Autoencoder::load(path)?;
        if loaded.architecture() != Architecture::Znbrdf {
            let found = loaded.architecture().name();
            return Err(Failure::InvalidFile(format!("{}: expected znbrdf, found {found}", path.display())).into());
        }
        Ok(Self { checkpoint: Some(Arc::new(loaded)), ..self })
    }

    /// With bases that have not seen the validation materials either.
    pub const fn without_validation(mut self) -> Self {
        self.validate = true;
        self
    }

    /// What errors are measured against.
    pub fn reference(&self) -> &Reference {
        &self.reference
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

    /// The basis of these options, of which each name has one.
    pub(super) fn pca(&self, options: PcaOptions) -> Result<Arc<PcaTables>> {
        let known = || self.pca.lock().unwrap_or_else(PoisonError::into_inner);
        let of_name = |all: &[(&str, Arc<PcaTables>)]| {
            all.iter().find(|(name, _)| *name == options.name).map(|(_, learned)| Arc::clone(learned))
        };
        if let Some(learned) = of_name(&known()) {
            return Ok(learned);
        }
        // Not under the lock: learning is parallel, and a thread that waits in it may be handed a task that asks here.
        let learned = Arc::new(PcaTables::learn(&self.training_materials(), options)?);
        let mut known = known();
        Ok(of_name(&known).unwrap_or_else(|| {
            known.push((options.name, Arc::clone(&learned)));
            learned
        }))
    }

    /// The reference materials that may be learned from.
    pub fn training_materials(&self) -> Vec<Material> {
        self.training(&self.reference.materials)
    }

    pub(super) fn pca_weights(&self) -> Result<Arc<WithNetwork<PcaWeights>>> {
        if let Some(known) = self.pca_weights.get() {
            return Ok(Arc::clone(known));
        }
        let learned = PcaWeights::learn(&self.training(&builtin::shared().materials()), DIM)?;
        Ok(Arc::clone(
            self.pca_weights.get_or_init(|| Arc::new(WithNetwork { inner: learned, source: shared_start_network })),
        ))
    }

    /// The affine span of the training materials' log tables.
    pub fn span(&self) -> Result<Arc<Span>> {
        if let Some(known) = self.span.get() {
            return Ok(Arc::clone(known));
        }
        let learned = Arc::new(Span::learn(&self.training_materials())?);
        Ok(Arc::clone(self.span.get_or_init(|| learned)))
    }

    /// The manifold of log tables in 15 coordinates.
    pub fn charting_15(&self) -> Result<Arc<Charting>> {
        self.charting(&self.charting_15, "charting_15", Options::MATERIALS)
    }

    /// The manifold of log tables in 2 coordinates.
    pub fn charting_2(&self) -> Result<Arc<Charting>> {
        self.charting(&self.charting_2, "charting_2", Options::MAP)
    }

    fn charting(&self, known: &OnceLock<Arc<Charting>>, name: &'static str, options: Options) -> Result<Arc<Charting>> {
        if let Some(known) = known.get() {
            return Ok(Arc::clone(known));
        }
        let learned = Arc::new(Charting::learn(name, self.span()?, options)?);
        Ok(Arc::clone(known.get_or_init(|| learned)))
    }

    /// The MERL materials that may be learned from.
    pub(super) fn training(&self, materials: &[Material]) -> Vec<Material> {
        let may_learn =
            |name: &str| Database::of(name) == Database::Merl && Split::of(name).is_learned_from(self.validate);
        materials.iter().filter(|material| may_learn(&material.name)).cloned().collect()
    }
}

fn unknown(what: &str, name: &str, known: impl Iterator<Item = &'static str>) -> anyhow::Error {
    let mut names: Vec<&str> = known.collect();
    names.dedup();
    let nearest = names.iter().max_by(|a, b| strsim::jaro(a, name).total_cmp(&strsim::jaro(b, name)));
    let nearest = nearest.copied().unwrap_or_default();
    Failure::Usage(format!("no {what} '{name}': did you mean '{nearest}'? There are {}", names.join(", "))).into()
}
