//! The coefficients of a combination, from all of a table or from a few samples of it: P′ a = b′.

use std::sync::Arc;

use faer::Mat;
use rayon::prelude::*;

use super::super::log_table::{self, corners, interpolated};
use super::super::measured_tables::{BasisError, MeasuredTables};
use crate::linear_system::LinearSystem;
use crate::nbrdf::objective::DARKEST;
use crate::{Directions, Rgb};

/// Rows of P′ in memory at once; up to as many, its singular values are found directly.
const PIECE: usize = 4096;

/// Which numbers are added up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// ln(f c + 10⁻³): dark and bright count alike.
    Logarithm,
    /// f c \[1/sr\] itself: highlights outweigh everything else a thousand times.
    Reflectance,
}

impl Domain {
    /// Strength of the ridge per measured value: the power of ten that serves best on the validation materials, among
    /// 10⁻⁶ to 10. For logarithms that is with 200 samples; it costs the whole table nothing that shows.
    pub const fn damping(self) -> f64 {
        match self {
            Self::Logarithm => 1e-3,
            Self::Reflectance => 1e-4,
        }
    }

    /// A number of a table in the domain.
    fn of_stored(self, stored: f32) -> f32 {
        match self {
            Self::Logarithm => stored,
            Self::Reflectance => stored.exp() - DARKEST,
        }
    }
}

/// What is measured, and how well that tells the coefficients.
pub struct Coefficients {
    basis: Arc<MeasuredTables>,
    domain: Domain,
    cells: Vec<usize>,
    /// One for each channel.
    systems: [LinearSystem; 3],
}

impl Coefficients {
    /// For measurements at these cells of a table.
    pub fn new(basis: Arc<MeasuredTables>, domain: Domain, cells: Vec<usize>) -> Result<Self, BasisError> {
        let system = |channel| match cells.len() <= PIECE {
            true => LinearSystem::of(&rows(&basis, domain, &cells, channel)),
            false => LinearSystem::of_gram(&gram(&basis, domain, &cells, channel)),
        };
        let systems = [system(0)?, system(1)?, system(2)?];
        Ok(Self { basis, domain, cells, systems })
    }

    /// Where is measured, as cells of a table.
    pub fn cells(&self) -> &[usize] {
        &self.cells
    }

    /// The measured materials.
    pub fn basis(&self) -> &Arc<MeasuredTables> {
        &self.basis
    }

    /// Condition number of P′, that of the worst channel.
    pub fn condition(&self) -> f64 {
        self.systems.iter().map(LinearSystem::condition).fold(0.0, f64::max)
    }

    /// What measured values say of the coefficients: P′ᵀ (b′ − that of the mean material), for each channel.
    ///
    /// `measured` is what a table holds at the cells, ln(f c + 10⁻³).
    ///
    /// # Panics
    /// If there is not one value per cell (a bug of the caller).
    pub fn slopes(&self, measured: &[Rgb]) -> [Vec<f64>; 3] {
        assert_eq!(measured.len(), self.cells.len(), "one value per cell");
        let materials = self.basis.tables().len();
        let share = 1.0 / materials as f64;
        [0, 1, 2].map(|channel| {
            let part = |(cells, measured): (&[usize], &[Rgb])| {
                let rows = rows(&self.basis, self.domain, cells, channel);
                let mut slope = vec![0.0; materials];
                for (row, value) in measured.iter().enumerate() {
                    let mean = share * (0..materials).map(|i| rows[(row, i)]).sum::<f64>();
                    let rest = f64::from(self.domain.of_stored(value[channel])) - mean;
                    slope.iter_mut().enumerate().for_each(|(i, slope)| *slope += rows[(row, i)] * rest);
                }
                slope
            };
            let parts: Vec<Vec<f64>> = self.cells.par_chunks(PIECE).zip(measured.par_chunks(PIECE)).map(part).collect();
            let mut sum = vec![0.0; materials];
            parts.iter().flat_map(|part| part.iter().enumerate()).for_each(|(i, v)| sum[i] += v);
            sum
        })
    }

    /// The coefficients from what measured values say of them: those of the first material for R, G, B, then of the
    /// second, ... `damping` is per measured value, and draws towards the mean of the measured materials; 0 is plain
    /// least squares.
    pub fn solve(&self, slopes: &[Vec<f64>; 3], damping: f64) -> Vec<f32> {
        let materials = self.basis.tables().len();
        let damping = damping * self.cells.len() as f64;
        let [r, g, b] = [0, 1, 2].map(|channel| self.systems[channel].solve(&slopes[channel], damping));
        let of = |own: f64| (1.0 / materials as f64 + own) as f32;
        (0..materials).flat_map(|i| [of(r[i]), of(g[i]), of(b[i])]).collect()
    }

    /// f_r \[1/sr\] of the combination with these coefficients at the pairs of `seen`, never negative.
    ///
    /// # Panics
    /// If there are not three coefficients for each measured material (a bug of the caller).
    pub fn predict(&self, seen: &Seen, coefficients: &[f32]) -> Vec<Rgb> {
        assert_eq!(coefficients.len(), 3 * seen.values.len(), "three coefficients for each material");
        let mut out = vec![Rgb::BLACK; seen.at.len()];
        out.par_chunks_mut(PIECE).enumerate().for_each(|(piece, out)| {
            for (own, values) in coefficients.as_chunks::<3>().0.iter().zip(&seen.values) {
                let values = &values[PIECE * piece..];
                for (out, value) in out.iter_mut().zip(values) {
                    *out = Rgb([0, 1, 2].map(|i| out[i] + own[i] * self.domain.of_stored(value[i])));
                }
            }
            for (out, &at) in out.iter_mut().zip(&seen.at[PIECE * piece..]) {
                let sum = match self.domain {
                    Domain::Logarithm => *out,
                    Domain::Reflectance => out.map(|v| (v.max(0.0) + DARKEST).ln()),
                };
                *out = log_table::restored(at, sum).map(|f| f.max(0.0));
            }
        });
        out
    }
}

/// What the measured materials show at some pairs: for asking many combinations there.
pub struct Seen {
    at: Vec<Directions>,
    /// Interpolated logarithms of each material.
    values: Vec<Vec<Rgb>>,
}

impl Seen {
    /// The materials at these pairs, all above the horizon.
    pub fn new(basis: &MeasuredTables, at: &[Directions]) -> Self {
        let corners: Vec<_> = at.par_iter().map(|&at| corners(at)).collect();
        let of = |table: &Vec<f32>| corners.iter().map(|corners| interpolated(table, corners)).collect();
        Self { at: at.to_vec(), values: basis.tables().par_iter().map(of).collect() }
    }
}

/// P′ of one channel \[cells, materials\].
fn rows(basis: &MeasuredTables, domain: Domain, cells: &[usize], channel: usize) -> Mat<f64> {
    let tables = basis.tables();
    Mat::from_fn(cells.len(), tables.len(), |row, i| f64::from(domain.of_stored(tables[i][3 * cells[row] + channel])))
}

/// P′ᵀP′ of one channel, summed in a fixed order.
fn gram(basis: &MeasuredTables, domain: Domain, cells: &[usize], channel: usize) -> Mat<f64> {
    let product = |cells: &[usize]| {
        let rows = rows(basis, domain, cells, channel);
        rows.transpose() * &rows
    };
    let products: Vec<Mat<f64>> = cells.par_chunks(PIECE).map(product).collect();
    let n = basis.tables().len();
    products.into_iter().fold(Mat::zeros(n, n), |sum, product| sum + product)
}
