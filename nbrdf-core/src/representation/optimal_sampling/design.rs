//! What makes places to measure good: a small condition number, or a small error to expect.
//!
//! The condition number of the reduced basis is J. B. Nielsen et al. (2015). The expected error is what
//! Z. Xu et al., *Minimal BRDF Sampling for Two-Shot Near-Field Reflectance Acquisition* (2016), turn to where it fails,
//! here for Gaussian coefficients: tr((QᵀQ + η)⁻¹ G) η, the error that the ridge leaves (K. Chaloner, I. Verdinelli,
//! *Bayesian Experimental Design: A Review*, 1995, A-optimality). It also tells single directions apart, whose
//! condition number is always 1, and knows components beyond the number of samples.

use faer::linalg::solvers::{DenseSolveCore, Llt};
use faer::{Mat, Side};

use super::super::log_table::{measurable, place};
use super::log_relative::LogRelative;
use crate::linear_system::LinearSystem;

/// By what places are chosen.
#[derive(Clone, Debug)]
pub enum Criterion {
    /// Condition number of the measured rows, in as many components as there are rows.
    ConditionNumber,
    /// Mean squared error of ln(f c + 10⁻³) to expect.
    ExpectedError {
        /// What a coefficient's error means: the components' Gram matrix, averaged over the table.
        gram: Mat<f64>,
        /// η of the ridge.
        damping: f64,
    },
}

impl Criterion {
    /// The expected error over the table under a ridge of this strength. Cells count half alike, which is dense where
    /// highlights are, and half by their width in θ_half, as the metrics do.
    pub fn expected_error(basis: &LogRelative, damping: f64) -> Self {
        let places = measurable();
        let k = basis.components();
        let width = |cell: usize| place(cell)[0] as f64 + 0.5;
        let total: f64 = places.iter().map(|&cell| width(cell)).sum();
        let mut gram = Mat::zeros(k, k);
        for cells in places.chunks(4096) {
            let rows = basis.matrix(cells);
            let weight = |cell: usize| 0.5 / places.len() as f64 + 0.5 * width(cell) / total;
            let weighted = Mat::from_fn(cells.len(), k, |row, k| weight(cells[row]) * rows[(row, k)]);
            gram += rows.transpose() * weighted;
        }
        Self::ExpectedError { gram: gram * faer::Scale(1.0 / basis.rows() as f64), damping }
    }

    /// How bad it is to measure these rows \[rows, components\]; less is better.
    pub fn cost(&self, rows: &Mat<f64>) -> f64 {
        match self {
            Self::ConditionNumber => condition(rows),
            Self::ExpectedError { .. } => self.cost_of_gram(&(rows.transpose() * rows)),
        }
    }

    /// As [`cost`](Self::cost), from the rows' Gram matrix: for blocks of thousands of rows.
    pub fn cost_of_gram(&self, measured: &Mat<f64>) -> f64 {
        match self {
            Self::ConditionNumber => LinearSystem::of_gram(measured).map_or(f64::INFINITY, |system| system.condition()),
            Self::ExpectedError { gram, damping } => match posterior(measured, *damping) {
                Some(posterior) => damping * trace_of_product(&posterior, gram),
                None => f64::INFINITY,
            },
        }
    }
}

/// Condition number of rows \[rows, components\] in their first components, at most as many as rows.
pub fn condition(rows: &Mat<f64>) -> f64 {
    let reduced = rows.subcols(0, rows.ncols().min(rows.nrows())).to_owned();
    LinearSystem::of(&reduced).map_or(f64::INFINITY, |system| system.condition())
}

/// (QᵀQ + η)⁻¹; none where numbers are not finite.
pub(super) fn posterior(measured: &Mat<f64>, damping: f64) -> Option<Mat<f64>> {
    let n = measured.nrows();
    let damped = Mat::from_fn(n, n, |i, j| measured[(i, j)] + if i == j { damping } else { 0.0 });
    Some(Llt::new(damped.as_ref(), Side::Lower).ok()?.inverse())
}

/// tr(A B) of symmetric matrices.
fn trace_of_product(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    (0..a.ncols()).map(|j| (0..a.nrows()).map(|i| a[(i, j)] * b[(i, j)]).sum::<f64>()).sum()
}
