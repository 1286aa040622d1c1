//! Linear PCA over tables of values: the row to beat.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 5 (45 components of logarithms over 90 × 90 × 180
//! cells), with the mappings of J. Nielsen et al., *On Optimal, Minimal BRDF Sampling* (2015), section 4.1. Differs: the
//! coarse grid is smaller and keeps the whole circle of φ_diff. Log-relative components are taken about the median itself
//! rather than about the mean of relative values: about the mean, the reference would cancel, since all materials share it.

mod file;

use super::grid::Grid;
use super::pca::{Centre, Pca, PcaError};
use super::pca_weights::checkpoint_of;
use super::value_table::ValueTable;
use super::values::Values;
use super::{Code, DecodeError, EncodeError, Representation};
use crate::{Brdf, Material};

/// What is learned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PcaOptions {
    /// Name of the representation; codes carry it.
    pub name: &'static str,
    /// Components.
    pub components: usize,
    /// Kind of the tables' numbers.
    pub values: Values,
    /// Cells of the tables. The basis takes 4 bytes × [`numbers`](Grid::numbers) × (components + 1): 76 MB for 32 over the
    /// coarse grid, 0.8 GB for 45 over that of MERL. Over the coarse grid it is made in the place of
    /// the training materials' tables (2.3 MB each); these come piece by piece over that of MERL: 0.9 GB for 45 of 80 materials, instead of 2.2; as much
    /// again where it is read from a file, and twice as much while it is written.
    pub grid: Grid,
}

impl PcaOptions {
    /// PROTOCOL of this project, "PCA-32".
    pub const PROTOCOL: Self = Self { name: "pca_tables", components: 32, values: Values::Log, grid: Grid::Coarse };
    /// As many components as Matusik et al. need for their materials.
    pub const LOG_45: Self = Self { name: "pca_45", components: 45, ..Self::PROTOCOL };
    /// As many of the reflectance times the cosine.
    pub const PLAIN_45: Self = Self { name: "pca_plain_45", values: Values::Plain, ..Self::LOG_45 };
    /// As many of the ratio to the median material.
    pub const RELATIVE_45: Self = Self { name: "pca_relative_45", values: Values::LogRelative, ..Self::LOG_45 };
}

/// Components over [`ValueTable`]s.
pub struct PcaTables {
    pub(super) options: PcaOptions,
    pub(super) pca: Pca,
    checkpoint: String,
}

impl PcaTables {
    /// Learns from the tables of the training materials.
    ///
    /// # Errors
    /// [`PcaError`]: not more materials than components, or values that are not finite.
    pub fn learn(training: &[Material], options: PcaOptions) -> Result<Self, PcaError> {
        let PcaOptions { components, values, grid, .. } = options;
        let centre = match values {
            Values::LogRelative => Centre::Median(values),
            Values::Plain | Values::Log => Centre::Mean,
        };
        let pca = match grid {
            Grid::Coarse => {
                let table = |material: &Material| ValueTable::tabulate(material.brdf.as_ref(), values, grid);
                let rows = training.iter().map(table).collect();
                match values {
                    Values::Log => Pca::learn(rows, components)?,
                    // Highlights of thousands beside a body of tenths.
                    Values::Plain | Values::LogRelative => Pca::learn_about(rows, centre, components)?,
                }
            }
            Grid::Merl => {
                let piece = |material: usize, at: std::ops::Range<usize>| {
                    let at = &grid.directions()[at.start / 3..at.end / 3];
                    ValueTable::tabulate_at(training[material].brdf.as_ref(), values, at)
                };
                Pca::learn_in_pieces(training.len(), grid.numbers(), &piece, centre, components)?
            }
        };
        Ok(Self { options, pca, checkpoint: checkpoint(training, options) })
    }
}

fn checkpoint(training: &[Material], PcaOptions { components, values, grid, .. }: PcaOptions) -> String {
    match (values, grid) {
        // Codes of the protocol's kind have carried this from the start.
        (Values::Log, Grid::Coarse) => checkpoint_of(training, &[components]),
        _ => checkpoint_of(training, &[components, values as usize, grid as usize]),
    }
}

impl Representation for PcaTables {
    fn name(&self) -> &'static str {
        self.options.name
    }

    fn dim(&self) -> usize {
        self.pca.components.len()
    }

    fn checkpoint(&self) -> &str {
        &self.checkpoint
    }

    fn shared_bytes(&self) -> usize {
        self.pca.bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let table = ValueTable::tabulate(target.brdf.as_ref(), self.options.values, self.options.grid);
        if table.iter().any(|v| !v.is_finite()) {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        }
        Ok(self.code(self.pca.project(&table)))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        let code = code.checked(self.name(), &self.checkpoint, self.dim())?;
        let PcaOptions { values, grid, .. } = self.options;
        Ok(Box::new(ValueTable::new(values, grid, self.pca.reconstruct(code))))
    }
}

#[cfg(test)]
mod tests;
