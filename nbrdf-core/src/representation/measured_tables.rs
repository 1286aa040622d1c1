//! The tables of measured materials side by side: what others are combined of, and what bases are learned from.

use std::collections::BTreeSet;

use rand::RngExt;
use rayon::prelude::*;

use super::basis::BasisFile;
use super::log_table::{self, TABLE_LEN, cells, measurable};
use super::value_table::ValueTable;
use crate::hash::short_hash;
use crate::tensor_file::TensorFileError;
use crate::{Brdf, Material, Rgb};

/// Largest number of a table in a file, which are logarithms.
const LARGEST_LOGARITHM: f64 = 200.0;
/// Cells that a thread takes at once.
const PIECE: usize = 4096;

/// [`log_table`]s of the training materials.
pub struct MeasuredTables {
    tables: Vec<Vec<f32>>,
    hash: String,
}

/// Why materials are no basis.
#[derive(Debug, thiserror::Error)]
pub enum BasisError {
    /// Fewer materials than anything can be learned from.
    #[error("a basis needs at least 2 training materials, found {0}")]
    TooFew(usize),
    /// A material evaluates to NaN or infinity.
    #[error("the training material '{0}' gives values that are not finite")]
    NotFinite(String),
    /// The principal components did not converge.
    #[error(transparent)]
    Components(#[from] super::pca::PcaError),
    /// The singular values did not converge.
    #[error(transparent)]
    System(#[from] crate::linear_system::NoConvergence),
}

impl MeasuredTables {
    /// Tabulates the materials, one after another in the order given.
    pub fn of(training: &[Material]) -> Result<Self, BasisError> {
        if training.len() < 2 {
            return Err(BasisError::TooFew(training.len()));
        }
        let tables: Vec<Vec<f32>> =
            training.par_iter().map(|material| log_table::tabulate(material.brdf.as_ref())).collect();
        let broken = tables.iter().zip(training).find(|(table, _)| table.iter().any(|v| !v.is_finite()));
        if let Some((_, material)) = broken {
            return Err(BasisError::NotFinite(material.name.clone()));
        }
        let hash = hash_of(training, &tables);
        Ok(Self { tables, hash })
    }

    /// With the tensor `tables` \[materials, numbers\].
    pub(super) fn write_into(&self, file: BasisFile) -> BasisFile {
        file.with_rows("tables", &self.tables)
    }

    /// As learned from what the file's checkpoint stands for.
    pub(super) fn of_file(file: &BasisFile) -> Result<Self, TensorFileError> {
        let tables: Vec<Vec<f32>> = file.rows("tables", TABLE_LEN, LARGEST_LOGARITHM)?;
        match tables.len() {
            0 | 1 => Err(file.lacks("tables of at least 2 materials", tables.len())),
            _ => Ok(Self { tables, hash: file.checkpoint().to_owned() }),
        }
    }

    /// The tables, each as long as [`TABLE_LEN`].
    pub fn tables(&self) -> &[Vec<f32>] {
        &self.tables
    }

    /// The table that is a sum of these: coefficients of the first for R, G, B, then of the second, ...
    ///
    /// # Panics
    /// If there are not three for each table (a bug of the caller).
    pub fn combine(&self, coefficients: &[f32]) -> ValueTable {
        assert_eq!(coefficients.len(), 3 * self.tables.len(), "three coefficients for each material");
        let mut out = vec![0.0; TABLE_LEN];
        out.par_chunks_mut(3 * PIECE).enumerate().for_each(|(piece, out)| {
            for (own, table) in coefficients.as_chunks::<3>().0.iter().zip(&self.tables) {
                let table = table[3 * PIECE * piece..].as_chunks::<3>().0;
                for (out, value) in out.as_chunks_mut::<3>().0.iter_mut().zip(table) {
                    *out = std::array::from_fn(|channel| out[channel] + own[channel] * value[channel]);
                }
            }
        });
        log_table::table(out)
    }

    /// Bytes of all tables.
    pub fn bytes(&self) -> usize {
        self.tables.iter().map(|table| size_of_val(table.as_slice())).sum()
    }

    /// Hash of what the tables are of, and so of what is learned from them.
    pub fn hash(&self) -> &str {
        &self.hash
    }
}

/// Hash of materials and their tables. Of networks where there are any: values differ in their last digit between kinds of
/// processors, and a code should be read on all of them. Of a table some thousand values; all would take a second.
pub(super) fn hash_of(materials: &[Material], tables: &[Vec<f32>]) -> String {
    let numbers = |(material, table): (&Material, &Vec<f32>)| match &material.network {
        Some(network) => network.weights().to_vec(),
        None => table.iter().step_by(97).copied().collect(),
    };
    short_hash(materials.iter().zip(tables).flat_map(numbers))
}

/// What a material shows at some cells of a table, as the table holds it: all that is measured of it.
pub fn measure(material: &dyn Brdf, at_cells: &[usize]) -> Vec<Rgb> {
    let grid = cells();
    let at: Vec<_> = at_cells.iter().map(|&cell| grid[cell]).collect();
    let values = crate::sampling::evaluate(material, &at);
    at.into_iter().zip(values).map(|(at, f)| log_table::stored(at, f)).collect()
}

/// `count` different cells that are above the horizon, all equally likely, in rising order; all of them where there are
/// no more.
pub fn random_cells(count: usize, seed: u64) -> Vec<usize> {
    let mut generator = crate::nbrdf::fit::generator(seed, 0);
    let all = measurable();
    let count = count.min(all.len());
    // R. Floyd's way (J. Bentley, *Programming Pearls: A Sample of Brilliance*, 1987): one draw for each.
    let mut chosen = BTreeSet::new();
    for last in all.len() - count..all.len() {
        if !chosen.insert(generator.random_range(0..=last)) {
            chosen.insert(last);
        }
    }
    chosen.into_iter().map(|index| all[index]).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::brdf::ggx::Ggx;

    /// Materials of falling gloss and turning colour, `count` of them.
    pub fn glossy(count: usize) -> Vec<Material> {
        let one = |i: usize| {
            let share = (i as f32 + 0.5) / count as f32;
            let turn = |by: f32| 0.25 + 0.2 * (7.0 * share + by).sin();
            let ggx = Ggx {
                diffuse: Rgb([turn(0.0), turn(1.0), turn(2.0)]),
                f0: Rgb::splat(0.04 + 0.5 * turn(3.0)),
                alpha: 0.1 + 0.5 * share,
            };
            Material::new(format!("glossy {i}"), Arc::new(ggx))
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn random_cells_are_distinct_above_the_horizon_and_those_of_their_seed() {
        let chosen = random_cells(800, 3);
        assert!(chosen.is_sorted_by(|a, b| a < b) && chosen.len() == 800);
        assert!(chosen.iter().all(|&cell| cells()[cell].is_above()));
        assert_eq!(chosen, random_cells(800, 3));
        assert_ne!(chosen, random_cells(800, 4));
        assert_eq!(random_cells(usize::MAX, 0), measurable());
    }

    #[test]
    fn what_is_measured_is_what_a_table_holds() {
        let material = &glossy(3)[1];
        let (table, chosen) = (log_table::tabulate(material.brdf.as_ref()), random_cells(50, 1));
        for (cell, measured) in chosen.iter().zip(measure(material.brdf.as_ref(), &chosen)) {
            assert!((0..3).all(|channel| (table[3 * cell + channel] - measured[channel]).abs() < 1e-5));
        }
    }

    #[test]
    fn a_single_material_is_no_basis() {
        assert!(matches!(MeasuredTables::of(&glossy(1)), Err(BasisError::TooFew(1))));
    }
}
