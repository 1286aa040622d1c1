//! The affine map that a connection leaves open, chosen such that charts keep their lengths.
//!
//! M. Brand, *Charting a Manifold*, section 4, determines coordinates "up to an affine transform". Here A minimises
//! Σ_k w_k |L_kᵀ Aᵀ A L_k − I|² over the charts' linear maps L_k: a linear equation for B = Aᵀ A, as for the metric upgrade of
//! C. Tomasi and T. Kanade, *Shape and Motion from Image Streams under Orthography* (1992), section 3.3. Then the axes are
//! turned to the principal ones of the points.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

use super::ChartingError;
use super::connection::Affine;

/// Least eigenvalue of B beside the largest: no coordinate is lost.
const FLAT: f64 = 1e-4;

/// A \[dim, dim\] for charts of these maps and weights.
pub(super) fn isometric(maps: &[Affine], weights: &[f64]) -> Result<Mat<f64>, ChartingError> {
    let dim = maps[0].offset.len();
    let squares: Vec<Mat<f64>> = maps.iter().map(|map| &map.linear * map.linear.transpose()).collect();
    let mut right = Mat::<f64>::zeros(dim * dim, 1);
    // Σ w (H ⊗ H) vec B = Σ w vec H with H = L Lᵀ.
    let mut normal = Mat::<f64>::zeros(dim * dim, dim * dim);
    for (square, &weight) in squares.iter().zip(weights) {
        for (row, (a, b)) in (0..dim).flat_map(|a| (0..dim).map(move |b| (a, b))).enumerate() {
            right[(row, 0)] += weight * square[(a, b)];
            for (column, (c, d)) in (0..dim).flat_map(|c| (0..dim).map(move |d| (c, d))).enumerate() {
                normal[(row, column)] += weight * square[(a, c)] * square[(b, d)];
            }
        }
    }
    let trace = (0..dim * dim).map(|i| normal[(i, i)]).sum::<f64>() / (dim * dim) as f64;
    (0..dim * dim).for_each(|i| normal[(i, i)] += 1e-10 * trace);
    let solved = Llt::new(normal.as_ref(), Side::Lower).map_err(|_| ChartingError::NoConvergence)?.solve(right);
    let metric = Mat::from_fn(dim, dim, |a, b| 0.5 * (solved[(a * dim + b, 0)] + solved[(b * dim + a, 0)]));
    square_root(&metric)
}

/// R A for the rotation R that turns the coordinates A x of all points to their principal axes, largest first; the largest
/// number on each axis is positive.
pub(super) fn to_principal_axes(by: &Mat<f64>, coordinates: &[Vec<f64>]) -> Result<Mat<f64>, ChartingError> {
    let dim = by.nrows();
    let points = Mat::from_fn(dim, coordinates.len(), |a, i| coordinates[i][a]);
    let moved = by * points;
    let covariance = &moved * moved.transpose();
    let eigen = covariance.self_adjoint_eigen(Side::Lower).map_err(|_| ChartingError::NoConvergence)?;
    let turned = Mat::from_fn(dim, dim, |a, b| eigen.U()[(b, dim - 1 - a)]);
    let places = &turned * &moved;
    let sign = |a: usize| {
        let largest =
            (0..places.ncols()).fold(0.0f64, |l, i| if places[(a, i)].abs() > l.abs() { places[(a, i)] } else { l });
        if largest < 0.0 { -1.0 } else { 1.0 }
    };
    let signs: Vec<f64> = (0..dim).map(sign).collect();
    Ok(Mat::from_fn(dim, dim, |a, b| signs[a] * turned[(a, b)]) * by)
}

/// The root of a symmetric matrix, its eigenvalues not below a part of the largest.
fn square_root(matrix: &Mat<f64>) -> Result<Mat<f64>, ChartingError> {
    let size = matrix.nrows();
    let eigen = matrix.self_adjoint_eigen(Side::Lower).map_err(|_| ChartingError::NoConvergence)?;
    let largest = eigen.S().column_vector()[size - 1];
    if !(largest.is_finite() && largest > 0.0) {
        return Err(ChartingError::NotConnected);
    }
    let roots: Vec<f64> = (0..size).map(|k| eigen.S().column_vector()[k].max(FLAT * largest).sqrt()).collect();
    let u = eigen.U();
    Ok(Mat::from_fn(size, size, |a, b| (0..size).map(|k| u[(a, k)] * roots[k] * u[(b, k)]).sum()))
}
