//! What is learned from measured tables: the tables themselves, the log-relative basis, and who decodes with them.

use std::sync::{Arc, OnceLock};

use anyhow::Result;
use nbrdf_core::representation::linear_combination::LinearCombination;
use nbrdf_core::representation::measured_tables::MeasuredTables;
use nbrdf_core::representation::optimal_sampling::basis::LogRelative;
use nbrdf_core::representation::optimal_sampling::{COMPONENTS, OptimalSampling};

use super::Catalog;

/// Something that is learned when first asked for. Not under a lock: learning is parallel, and a thread that waits in it
/// may be handed a task that asks here.
struct Once<T>(OnceLock<Arc<T>>);

impl<T> Once<T> {
    const fn new() -> Self {
        Self(OnceLock::new())
    }

    fn get(&self, learn: impl FnOnce() -> Result<T>) -> Result<Arc<T>> {
        if let Some(known) = self.0.get() {
            return Ok(Arc::clone(known));
        }
        let learned = Arc::new(learn()?);
        Ok(Arc::clone(self.0.get_or_init(|| learned)))
    }
}

/// The costly parts, each learned once.
pub(super) struct Measured {
    tables: Once<MeasuredTables>,
    components: Once<LogRelative>,
    combination: Once<LinearCombination>,
    combination_800: Once<LinearCombination>,
    optimal_5: Once<OptimalSampling>,
    optimal_20: Once<OptimalSampling>,
}

impl Measured {
    pub(super) const fn new() -> Self {
        Self {
            tables: Once::new(),
            components: Once::new(),
            combination: Once::new(),
            combination_800: Once::new(),
            optimal_5: Once::new(),
            optimal_20: Once::new(),
        }
    }
}

impl Catalog {
    /// Tables of the training materials.
    pub fn measured_tables(&self) -> Result<Arc<MeasuredTables>> {
        self.measured.tables.get(|| Ok(MeasuredTables::of(&self.training_materials())?))
    }

    /// The log-relative basis of their channels; of fewer components where there are few materials.
    pub fn log_relative(&self) -> Result<Arc<LogRelative>> {
        self.measured.components.get(|| {
            let tables = self.measured_tables()?;
            let most = 3 * tables.tables().len() - 1;
            Ok(LogRelative::learn(&tables, COMPONENTS.min(most))?)
        })
    }

    pub(super) fn linear_combination(&self) -> Result<Arc<LinearCombination>> {
        self.measured.combination.get(|| Ok(LinearCombination::of_tables(self.measured_tables()?)?))
    }

    pub(super) fn linear_combination_800(&self) -> Result<Arc<LinearCombination>> {
        self.measured.combination_800.get(|| Ok(LinearCombination::of_samples(self.measured_tables()?)?))
    }

    pub(super) fn optimal_sampling_5(&self) -> Result<Arc<OptimalSampling>> {
        self.measured.optimal_5.get(|| self.optimal_sampling("optimal_sampling_5", 5))
    }

    pub(super) fn optimal_sampling_20(&self) -> Result<Arc<OptimalSampling>> {
        self.measured.optimal_20.get(|| self.optimal_sampling("optimal_sampling_20", 20))
    }

    fn optimal_sampling(&self, name: &'static str, count: usize) -> Result<OptimalSampling> {
        let tables = self.measured_tables()?;
        Ok(OptimalSampling::learn(name, self.log_relative()?, tables.hash(), count))
    }
}
