//! Principal components of the log-relative values of all channels of all materials.
//!
//! J. B. Nielsen, H. W. Jensen, R. Ramamoorthi (2015): ρ ↦ ln((ρ c + ε) / (ρ_med c + ε)) with ε = 10⁻³, a row for each
//! channel of each material, components scaled by their singular values. The median is common to all rows and cancels in
//! components about the mean, so that it is never formed. Differs: c = max(cos θ_i, 0.05) of [`log_table`] for their product
//! of both cosines, so that logarithms of tables are all that is needed.

use faer::Mat;
use rayon::prelude::*;

use super::super::basis::BasisFile;
use super::super::log_table::{self, TABLE_LEN, corners, measurable, sources};
use super::super::measured_tables::{BasisError, MeasuredTables};
use super::super::pca::Pca;
use super::super::value_table::ValueTable;
use crate::tensor_file::{Numbers, TensorFileError};
use crate::{Directions, Rgb};

/// Largest number in a file: logarithms, and components times singular values of a few hundred rows of them.
const LARGEST: f64 = 1e4;
/// Cells that a thread takes at once.
const PIECE: usize = 1024;

/// Mean and scaled components over the cells that are above the horizon.
pub struct LogRelative {
    /// Scaled components of each cell \[cells, components\].
    loadings: Vec<f32>,
    /// Mean \[cells\].
    base: Vec<f32>,
    components: usize,
    /// Rows learned from: coefficients of a material have variance 1/rows.
    rows: usize,
    /// Where in the above the values of each cell of a table are.
    slots: Vec<u32>,
}

impl LogRelative {
    /// Learns so many components.
    pub fn learn(tables: &MeasuredTables, components: usize) -> Result<Self, BasisError> {
        let places = measurable();
        let tables = tables.tables();
        let rows: Vec<Vec<f32>> = (0..3 * tables.len())
            .into_par_iter()
            .map(|row| places.iter().map(|&cell| tables[row / 3][3 * cell + row % 3]).collect())
            .collect();
        let count = rows.len();
        let pca = Pca::learn(rows.clone(), components)?;
        let coordinates: Vec<Vec<f32>> = rows.par_iter().map(|row| pca.project(row)).collect();
        let singular = |k: usize| coordinates.iter().map(|row| f64::from(row[k]).powi(2)).sum::<f64>().sqrt() as f32;
        let scales: Vec<f32> = (0..components).map(singular).collect();
        let loading =
            |index: usize| pca.components[index % components][index / components] * scales[index % components];
        let loadings = (0..places.len() * components).into_par_iter().map(loading).collect();
        let base = pca.mean;
        Ok(Self { loadings, base, components, rows: count, slots: slots() })
    }

    /// With `loadings` \[cells, components\] and `base` \[cells\].
    pub(in crate::representation) fn write_into(&self, file: BasisFile) -> BasisFile {
        let cells = self.base.len();
        file.with("loadings", &[cells, self.components], Numbers::F32(self.loadings.clone())).with(
            "base",
            &[cells],
            Numbers::F32(self.base.clone()),
        )
    }

    /// Of a file that also says how many rows it was learned from.
    pub(in crate::representation) fn of_file(file: &BasisFile) -> Result<Self, TensorFileError> {
        #[derive(serde::Deserialize)]
        struct Details {
            rows: usize,
        }
        let Details { rows } = file.details()?;
        let cells = measurable().len();
        let components = match file.shape("loadings")? {
            &[_, components] if (1..rows).contains(&components) => components,
            found => return Err(file.lacks("fewer loadings than rows learned from", format!("{found:?} of {rows}"))),
        };
        let loadings = file.tensor("loadings", &[cells, components], LARGEST)?.to_vec();
        let base = file.tensor("base", &[cells], LARGEST)?.to_vec();
        Ok(Self { loadings, base, components, rows, slots: slots() })
    }

    /// Number of components.
    pub const fn components(&self) -> usize {
        self.components
    }

    /// Rows learned from, three for each material.
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Bytes of components, base and map.
    pub fn bytes(&self) -> usize {
        size_of_val(self.loadings.as_slice()) + size_of_val(self.base.as_slice()) + size_of_val(self.slots.as_slice())
    }

    /// The scaled components at a cell of a table.
    pub fn loadings(&self, cell: usize) -> &[f32] {
        &self.loadings[self.slots[cell] as usize * self.components..][..self.components]
    }

    /// ln(f c + 10⁻³) of the middle material at a cell of a table.
    pub fn base(&self, cell: usize) -> f32 {
        self.base[self.slots[cell] as usize]
    }

    /// The scaled components at these cells \[cells, components\].
    pub fn matrix(&self, cells: &[usize]) -> Mat<f64> {
        Mat::from_fn(cells.len(), self.components, |row, k| f64::from(self.loadings(cells[row])[k]))
    }

    /// The scaled components at a pair, interpolated as a table is.
    pub fn loadings_at(&self, at: Directions) -> Vec<f64> {
        let mut sum = vec![0.0; self.components];
        for (cell, weight) in corners(at) {
            let loadings = self.loadings(cell);
            sum.iter_mut().zip(loadings).for_each(|(sum, v)| *sum += f64::from(weight * v));
        }
        sum
    }

    /// The middle material at a pair, interpolated as a table is.
    pub fn base_at(&self, at: Directions) -> f64 {
        corners(at).map(|(cell, weight)| f64::from(weight * self.base(cell))).iter().sum()
    }

    /// f_r \[1/sr\] of a material from its coefficients at the pairs of `seen`, never negative.
    ///
    /// # Panics
    /// If there is not one coefficient per component (a bug of the caller).
    pub fn predict(&self, seen: &SeenComponents, coefficients: &[Vec<f32>; 3]) -> Vec<Rgb> {
        assert!(coefficients.iter().all(|own| own.len() == self.components), "one coefficient per component");
        let one = |((&at, &base), loadings): ((&Directions, &f32), &[f32])| {
            let stored = coefficients.each_ref().map(|own| base + dot(loadings, own));
            log_table::restored(at, Rgb(stored)).map(|f| f.max(0.0))
        };
        let pairs = seen.at.par_iter().zip(&seen.base).zip(seen.loadings.par_chunks(self.components));
        pairs.map(one).collect()
    }

    /// The table of a material from its coefficients, those of each channel together.
    ///
    /// # Panics
    /// If there is not one coefficient per component (a bug of the caller).
    pub fn table(&self, coefficients: &[Vec<f32>; 3]) -> ValueTable {
        assert!(coefficients.iter().all(|own| own.len() == self.components), "one coefficient per component");
        let mut values = vec![0.0; TABLE_LEN];
        values.par_chunks_mut(3 * PIECE).enumerate().for_each(|(piece, values)| {
            for (offset, value) in values.as_chunks_mut::<3>().0.iter_mut().enumerate() {
                let cell = piece * PIECE + offset;
                let loadings = self.loadings(cell);
                *value = coefficients.each_ref().map(|own| self.base(cell) + dot(loadings, own));
            }
        });
        log_table::table(values)
    }
}

/// Components and middle material at some pairs: for asking many materials there.
pub struct SeenComponents {
    at: Vec<Directions>,
    base: Vec<f32>,
    /// \[pairs, components\]
    loadings: Vec<f32>,
}

impl SeenComponents {
    /// The basis at these pairs, all above the horizon.
    pub fn new(basis: &LogRelative, at: &[Directions]) -> Self {
        let base = at.par_iter().map(|&at| basis.base_at(at) as f32).collect();
        let loadings: Vec<Vec<f64>> = at.par_iter().map(|&at| basis.loadings_at(at)).collect();
        Self { at: at.to_vec(), base, loadings: loadings.into_iter().flatten().map(|v| v as f32).collect() }
    }
}

/// The place among the cells above the horizon at which the values of each cell are.
fn slots() -> Vec<u32> {
    let mut slots = vec![0; TABLE_LEN / 3];
    measurable().iter().zip(0..).for_each(|(&cell, slot)| slots[cell] = slot);
    sources().iter().map(|&source| slots[source]).collect()
}

fn dot(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::super::super::measured_tables::tests::glossy;
    use super::super::super::pca::PcaError;
    use super::*;

    #[test]
    fn a_channel_of_a_learned_material_is_base_and_components() {
        let tables = MeasuredTables::of(&glossy(4)).unwrap();
        let basis = LogRelative::learn(&tables, 11).unwrap();
        // The best coefficients for the red of the third, from all cells.
        let matrix = basis.matrix(measurable());
        let rest = measurable().iter().map(|&cell| f64::from(tables.tables()[2][3 * cell] - basis.base(cell)));
        let rest: Vec<f64> = rest.collect();
        let system = crate::linear_system::LinearSystem::of_gram(&(matrix.transpose() * &matrix)).unwrap();
        let slope: Vec<f64> =
            (0..11).map(|k| rest.iter().enumerate().map(|(row, rest)| matrix[(row, k)] * rest).sum()).collect();
        let red: Vec<f32> = system.solve(&slope, 0.0).into_iter().map(|x| x as f32).collect();
        // Scaled components have coefficients of a row of an orthonormal matrix.
        assert!(red.iter().map(|x| x * x).sum::<f32>() < 1.001, "{red:?}");
        for (&cell, rest) in measurable().iter().zip(&rest).step_by(101) {
            let own: f32 = basis.loadings(cell).iter().zip(&red).map(|(q, x)| q * x).sum();
            assert!((f64::from(own) - rest).abs() < 2e-3, "{own} {rest}");
        }
    }

    #[test]
    fn more_components_than_rows_are_refused() {
        let tables = MeasuredTables::of(&glossy(2)).unwrap();
        assert!(matches!(LogRelative::learn(&tables, 6), Err(BasisError::Components(PcaError::TooFew { .. }))));
    }
}
