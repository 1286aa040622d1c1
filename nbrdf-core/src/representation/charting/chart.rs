//! One local projection: the weighted principal axes of a neighbourhood.
//!
//! M. Brand, *Charting a Manifold*, section 4: W_k holds the leading eigenvectors of Σ_k. Differs: off the chart, variance
//! is the same in all directions (M. Tipping and C. Bishop, *Mixtures of Probabilistic Principal Component Analyzers*,
//! 1999, section 3), which with one dimension more than the chart's is the paper's density. With many more, the least
//! variances are noise, and would decide alone which chart a point belongs to.

use faer::{Mat, Side};

use super::vector::{dot, squared_distance};

/// Least variance beside the largest.
const FLAT: f64 = 1e-6;

/// A Gaussian with `dim` axes of its own.
pub(super) struct Chart {
    /// Centre μ.
    pub mean: Vec<f64>,
    /// Rows of W, orthonormal, largest variance first.
    pub axes: Vec<Vec<f64>>,
    /// Variance along each axis.
    pub variances: Vec<f64>,
    /// Variance along every direction off the axes.
    pub off: f64,
    /// Logarithm of the determinant.
    log_determinant: f64,
}

impl Chart {
    /// The leading axes of a covariance; none where it has no eigenvalues.
    pub fn new(mean: &[f64], covariance: &Mat<f64>, dim: usize) -> Option<Self> {
        let size = mean.len();
        let eigen = covariance.self_adjoint_eigen(Side::Lower).ok()?;
        // faer sorts eigenvalues upwards
        let value = |k: usize| eigen.S().column_vector()[size - 1 - k];
        let least = (FLAT * value(0)).max(f64::MIN_POSITIVE);
        let variances: Vec<f64> = (0..dim).map(|k| value(k).max(least)).collect();
        let rest = size - dim;
        let off = ((dim..size).map(value).sum::<f64>() / rest.max(1) as f64).max(least);
        let axis = |k: usize| (0..size).map(|row| eigen.U()[(row, size - 1 - k)]).collect();
        let chart = Self::of_axes(mean.to_vec(), (0..dim).map(axis).collect(), variances, off);
        chart.log_determinant.is_finite().then_some(chart)
    }

    /// With axes, variances along them, and the one off them.
    pub fn of_axes(mean: Vec<f64>, axes: Vec<Vec<f64>>, variances: Vec<f64>, off: f64) -> Self {
        let rest = mean.len() - variances.len();
        let log_determinant = variances.iter().map(|v| v.ln()).sum::<f64>() + rest as f64 * off.ln();
        Self { mean, axes, variances, off, log_determinant }
    }

    /// Coordinates of a point's projection, u = W (y − μ).
    pub fn local(&self, point: &[f64]) -> Vec<f64> {
        let offset: Vec<f64> = point.iter().zip(&self.mean).map(|(p, m)| p - m).collect();
        self.axes.iter().map(|axis| dot(axis, &offset)).collect()
    }

    /// Logarithm of the density, up to a constant that is the same for all charts.
    pub fn log_density(&self, point: &[f64]) -> f64 {
        let local = self.local(point);
        let along: f64 = local.iter().zip(&self.variances).map(|(u, v)| u * u / v).sum();
        let across = (squared_distance(point, &self.mean) - dot(&local, &local)).max(0.0) / self.off;
        -0.5 * (along + across + self.log_determinant)
    }
}
