//! A material from its reflectance in a few directions, chosen so that they tell most of it.
//!
//! J. B. Nielsen, H. W. Jensen, R. Ramamoorthi, *On Optimal, Minimal BRDF Sampling for Reflectance Acquisition* (2015): a
//! log-relative basis ([`log_relative`]), a ridge that finds a material's coefficients from n samples, and the n
//! directions for which that is well posed ([`directions`]). Differs: forty components however few the samples, since
//! the ridge knows how large each may be, and η = 1 for their 40, since networks have no noise to guard against, both
//! chosen on the validation materials; and directions are those of the least expected error ([`design`]), which comes
//! closer there than those of the least condition number. `nbrdf reconstruct` measures both.
//!
//! The code is the measurement itself: ln(f c + 10⁻³) at every direction, for red, green and blue.

pub mod design;
pub mod directions;
mod file;
pub mod images;
pub mod log_relative;

use std::sync::Arc;

use design::{Criterion, posterior};
use directions::choose;
use faer::Mat;
use log_relative::LogRelative;

use super::measured_tables::measure;
use super::value_table::ValueTable;
use super::{Code, DecodeError, EncodeError, Representation};
use crate::hash::short_hash;
use crate::{Brdf, Material, Rgb};

/// Components of the basis.
pub const COMPONENTS: usize = 40;
/// η of the ridge; coefficients of a material have a variance of one over the number of rows learned from.
pub const DAMPING: f64 = 1.0;
/// η of the paper, for measured tables and their noise.
pub const PUBLISHED_DAMPING: f64 = 40.0;

/// How a material is found from what is measured at some cells of a table.
pub struct Reconstruction {
    basis: Arc<LogRelative>,
    cells: Vec<usize>,
    /// Coefficients from measured values \[components, cells\].
    operator: Mat<f64>,
}

impl Reconstruction {
    /// From measurements at these cells, under a ridge of strength η > 0.
    pub fn new(basis: Arc<LogRelative>, cells: Vec<usize>, damping: f64) -> Self {
        let rows = basis.matrix(&cells);
        // A ridge has an inverse; were it not finite, everything would be the middle material.
        let zero = || Mat::zeros(basis.components(), basis.components());
        let uncertain = posterior(&(rows.transpose() * &rows), damping).unwrap_or_else(zero);
        Self { operator: uncertain * rows.transpose(), basis, cells }
    }

    /// Where is measured, as cells of a table.
    pub fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// The coefficients of each channel from what a table holds at the cells, ln(f c + 10⁻³).
    ///
    /// # Panics
    /// If there is not one value per cell (a bug of the caller).
    pub fn coefficients(&self, measured: &[Rgb]) -> [Vec<f32>; 3] {
        assert_eq!(measured.len(), self.cells.len(), "one value per cell");
        [0, 1, 2].map(|channel| {
            let rest = |(value, &cell): (&Rgb, &usize)| f64::from(value[channel]) - f64::from(self.basis.base(cell));
            let rest: Vec<f64> = measured.iter().zip(&self.cells).map(rest).collect();
            let along = |k: usize| rest.iter().enumerate().map(|(i, rest)| self.operator[(k, i)] * rest).sum::<f64>();
            (0..self.basis.components()).map(|k| along(k) as f32).collect()
        })
    }

    /// The material from what a table holds at the cells, ln(f c + 10⁻³).
    ///
    /// # Panics
    /// If there is not one value per cell (a bug of the caller).
    pub fn reconstruct(&self, measured: &[Rgb]) -> ValueTable {
        self.basis.table(&self.coefficients(measured))
    }
}

/// Three numbers for each direction.
pub struct OptimalSampling {
    name: &'static str,
    reconstruction: Reconstruction,
    checkpoint: String,
}

impl OptimalSampling {
    /// Chooses `count` directions for a basis that was learned from what has this hash.
    pub fn learn(name: &'static str, basis: Arc<LogRelative>, learned_from: &str, count: usize) -> Self {
        let criterion = Criterion::expected_error(&basis, DAMPING);
        let cells = choose(&basis, count, &criterion, &criterion);
        let mark = learned_from.bytes().map(f32::from);
        let checkpoint = short_hash(mark.chain(cells.iter().map(|&cell| cell as f32)));
        Self { name, reconstruction: Reconstruction::new(basis, cells, DAMPING), checkpoint }
    }

    /// Where is measured, as cells of a table.
    pub fn cells(&self) -> &[usize] {
        self.reconstruction.cells()
    }
}

impl Representation for OptimalSampling {
    fn name(&self) -> &'static str {
        self.name
    }

    fn dim(&self) -> usize {
        3 * self.cells().len()
    }

    fn checkpoint(&self) -> &str {
        &self.checkpoint
    }

    fn shared_bytes(&self) -> usize {
        self.reconstruction.basis.bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let measured = measure(target.brdf.as_ref(), self.cells());
        if !measured.iter().all(|value| value.is_finite()) {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        }
        Ok(self.code(measured.into_iter().flat_map(|value| value.0).collect()))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        let code = code.checked(self.name(), &self.checkpoint, self.dim())?;
        let measured: Vec<Rgb> = code.as_chunks::<3>().0.iter().map(|value| Rgb(*value)).collect();
        Ok(Box::new(self.reconstruction.reconstruct(&measured)))
    }
}

#[cfg(test)]
mod tests;
