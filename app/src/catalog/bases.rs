//! What is learned from tables of measured materials: components, charts, sums, directions.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::Material;
use nbrdf_core::library::builtin;
use nbrdf_core::representation::basis::Basis;
use nbrdf_core::representation::charting::{Charting, Options, Span};
use nbrdf_core::representation::linear_combination::LinearCombination;
use nbrdf_core::representation::measured_tables::MeasuredTables;
use nbrdf_core::representation::optimal_sampling::log_relative::LogRelative;
use nbrdf_core::representation::optimal_sampling::{COMPONENTS, OptimalSampling};
use nbrdf_core::representation::pca_tables::{PcaOptions, PcaTables};
use nbrdf_core::representation::pca_weights::PcaWeights;
use rayon::prelude::*;

use super::twin::{WithNetwork, shared_start_network};
use super::{Catalog, DIM};

impl Catalog {
    /// A basis from the file that was named, if it is of this representation, or learned anew.
    fn basis<B: Basis + 'static>(&self, name: &'static str, learn: impl FnOnce() -> Result<B>) -> Result<Arc<B>> {
        self.learned.get(name, || match self.held.as_ref().and_then(|held| held.of(name)) {
            Some(file) => Ok(B::of_file(name, file)?),
            None => learn(),
        })
    }

    /// The basis of these options, of which each name has one.
    pub(super) fn pca(&self, options: PcaOptions) -> Result<Arc<PcaTables>> {
        let size = self.size;
        let options = PcaOptions {
            components: size.numbers.unwrap_or(options.components),
            grid: size.grid.unwrap_or(options.grid),
            ..options
        };
        self.basis(options.name, || Ok(PcaTables::learn(&self.training_materials(), options)?))
    }

    /// Components of weights.
    pub(super) fn pca_weights(&self) -> Result<Arc<PcaWeights>> {
        let numbers = self.size.numbers.unwrap_or(DIM);
        self.basis("pca_weights", || Ok(PcaWeights::learn(&self.shared_start_materials(), numbers)?))
    }

    /// The training materials as networks of the shared start: the built-in ones, or fits.
    fn shared_start_materials(&self) -> Vec<Material> {
        match &self.given {
            None => self.training(&builtin::shared().materials()),
            Some(_) => {
                let shared = |material: Material| match shared_start_network(&material) {
                    Some(network) => Material::from_network(material.name, network),
                    None => material,
                };
                self.training_materials().into_par_iter().map(shared).collect()
            }
        }
    }

    /// The same, handed networks of the shared start.
    pub(super) fn pca_of_shared_start(&self) -> Result<Arc<WithNetwork<Arc<PcaWeights>>>> {
        Ok(Arc::new(WithNetwork { inner: self.pca_weights()?, source: shared_start_network }))
    }

    /// The affine span of the training materials' log tables.
    pub fn span(&self) -> Result<Arc<Span>> {
        self.learned.get("span", || Ok(Span::learn(&self.training_materials())?))
    }

    /// The manifold of log tables in 15 coordinates.
    pub fn charting_15(&self) -> Result<Arc<Charting>> {
        self.charting("charting_15", Options::MATERIALS)
    }

    /// The manifold of log tables in 2 coordinates.
    pub fn charting_2(&self) -> Result<Arc<Charting>> {
        self.charting("charting_2", Options::MAP)
    }

    fn charting(&self, name: &'static str, options: Options) -> Result<Arc<Charting>> {
        let options = Options { dim: self.size.numbers.unwrap_or(options.dim), ..options };
        self.basis(name, || Ok(Charting::learn(name, self.span()?, options)?))
    }

    /// Tables of the training materials.
    pub fn measured_tables(&self) -> Result<Arc<MeasuredTables>> {
        self.learned.get("measured_tables", || Ok(MeasuredTables::of(&self.training_materials())?))
    }

    /// The log-relative basis of their channels; of fewer components where there are few materials.
    pub fn log_relative(&self) -> Result<Arc<LogRelative>> {
        self.learned.get("log_relative", || {
            let tables = self.measured_tables()?;
            let most = 3 * tables.tables().len() - 1;
            Ok(LogRelative::learn(&tables, COMPONENTS.min(most))?)
        })
    }

    pub(super) fn linear_combination(&self) -> Result<Arc<LinearCombination>> {
        self.basis("linear_combination", || Ok(LinearCombination::of_tables(self.measured_tables()?)?))
    }

    pub(super) fn linear_combination_800(&self) -> Result<Arc<LinearCombination>> {
        self.basis("linear_combination_800", || Ok(LinearCombination::of_samples(self.measured_tables()?)?))
    }

    pub(super) fn optimal_sampling_5(&self) -> Result<Arc<OptimalSampling>> {
        self.optimal_sampling("optimal_sampling_5", 5)
    }

    pub(super) fn optimal_sampling_20(&self) -> Result<Arc<OptimalSampling>> {
        self.optimal_sampling("optimal_sampling_20", 20)
    }

    fn optimal_sampling(&self, name: &'static str, count: usize) -> Result<Arc<OptimalSampling>> {
        let count = self.size.numbers.unwrap_or(count);
        self.basis(name, || {
            let tables = self.measured_tables()?;
            Ok(OptimalSampling::learn(name, self.log_relative()?, tables.hash(), count))
        })
    }
}
