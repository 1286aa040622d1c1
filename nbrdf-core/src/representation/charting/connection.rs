//! The connection: one affine map per chart, such that charts agree where they share points.
//!
//! M. Brand, *Charting a Manifold*, section 4, equation 5: the maps G_k minimise Σ p_k(y_i) p_j(y_i) |G_k ũ_ki − G_j ũ_ji|²
//! with ũ = (u, 1). As the p_k add up to 1, that is 2 tr G (D − U Uᵀ) Gᵀ, with column i of U the stacked p_k(y_i) ũ_ki
//! and D block-diagonal of Σ_i p_k(y_i) ũ_ki ũ_kiᵀ. Differs from equation 8: not the weights G but the points' coordinates
//! G U have mean 0 and unit covariance (Y. W. Teh and S. Roweis, *Automatic Alignment of Local Representations*, NIPS
//! 2002, section 3, which the paper names as its relative): the same trailing eigenvectors, now of the pencil
//! (D − U Uᵀ, U Uᵀ), do not depend on the units of the data, and are found on the shorter side of U.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

use super::ChartingError;

/// x = linear · u + offset.
#[derive(Clone)]
pub(super) struct Affine {
    /// \[dim, dim\].
    pub linear: Mat<f64>,
    /// \[dim\].
    pub offset: Vec<f64>,
}

/// Maps of all charts into common coordinates.
pub(super) struct Connection {
    /// One per chart.
    pub maps: Vec<Affine>,
    /// Share of each coordinate's variance on which the charts agree, 0..1, largest first.
    pub agreement: Vec<f64>,
}

/// Connects charts from the points' `local` coordinates \[charts, points, dim\] and `weights` p_k \[points, charts\];
/// `ridge`, one per chart, is added to the mean square of its local coordinates: charts of few points stay flat.
pub(super) fn connect(
    local: &[Vec<Vec<f64>>],
    weights: &[Vec<f64>],
    ridge: &[f64],
) -> Result<Connection, ChartingError> {
    let (charts, points) = (local.len(), weights.len());
    let dim = local[0][0].len();
    let size = dim + 1;
    let lifted = |k: usize, i: usize, a: usize| if a < dim { local[k][i][a] } else { 1.0 };
    let mut factors = Vec::with_capacity(charts);
    // L⁻¹ U with D = L Lᵀ, block by block.
    let mut whitened = Mat::<f64>::zeros(charts * size, points);
    for (k, ridge) in ridge.iter().enumerate() {
        let mut block = Mat::from_fn(size, size, |a, b| {
            (0..points).map(|i| weights[i][k] * lifted(k, i, a) * lifted(k, i, b)).sum::<f64>()
        });
        let total = block[(dim, dim)];
        (0..dim).for_each(|a| block[(a, a)] += ridge * total);
        let factor = Llt::new(block.as_ref(), Side::Lower).map_err(|_| ChartingError::NoConvergence)?;
        let own = Mat::from_fn(size, points, |a, i| weights[i][k] * lifted(k, i, a));
        let half = forward_substitution(factor.L(), &own);
        // The same constant in every chart agrees perfectly and says nothing: less its mean, each row is without it.
        for a in 0..size {
            let mean = (0..points).map(|i| half[(a, i)]).sum::<f64>() / points as f64;
            (0..points).for_each(|i| whitened[(k * size + a, i)] = half[(a, i)] - mean);
        }
        factors.push((factor, own));
    }
    let (coordinates, agreement) = leading(&whitened, dim)?;
    let maps = factors.iter().map(|(factor, own)| {
        // G_kᵀ = D_k⁻¹ U_k x / agreement
        let solved = factor.solve(own * &coordinates);
        let linear = Mat::from_fn(dim, dim, |c, a| solved[(a, c)] / agreement[c]);
        Affine { linear, offset: (0..dim).map(|c| solved[(dim, c)] / agreement[c]).collect() }
    });
    Ok(Connection { maps: maps.collect(), agreement })
}

/// The `count` leading right singular vectors, of norm √points as columns \[points, count\], and the squared singular
/// values; from whichever product of the matrix with itself is the smaller.
fn leading(matrix: &Mat<f64>, count: usize) -> Result<(Mat<f64>, Vec<f64>), ChartingError> {
    let points = matrix.ncols();
    let tall = matrix.nrows() > points;
    let product = if tall { matrix.transpose() * matrix } else { matrix * matrix.transpose() };
    let eigen = product.self_adjoint_eigen(Side::Lower).map_err(|_| ChartingError::NoConvergence)?;
    let last = product.nrows() - 1;
    let values: Vec<f64> = (0..count).map(|k| eigen.S().column_vector()[last - k]).collect();
    if !values.iter().all(|value| value.is_finite() && *value > 1e-9) {
        return Err(ChartingError::NotConnected);
    }
    let vectors = Mat::from_fn(last + 1, count, |row, k| eigen.U()[(row, last - k)]);
    let vectors = if tall { vectors } else { matrix.transpose() * vectors };
    let length = |k: usize| (0..points).map(|i| vectors[(i, k)] * vectors[(i, k)]).sum::<f64>().sqrt();
    let scales: Vec<f64> = (0..count).map(|k| (points as f64).sqrt() / length(k)).collect();
    Ok((Mat::from_fn(points, count, |i, k| scales[k] * vectors[(i, k)]), values))
}

/// L⁻¹ B.
fn forward_substitution(lower: faer::MatRef<'_, f64>, right: &Mat<f64>) -> Mat<f64> {
    let mut solved = right.clone();
    for column in 0..right.ncols() {
        for row in 0..right.nrows() {
            let known: f64 = (0..row).map(|k| lower[(row, k)] * solved[(k, column)]).sum();
            solved[(row, column)] = (solved[(row, column)] - known) / lower[(row, row)];
        }
    }
    solved
}
