//! Soft neighbourhoods: a Gaussian kernel around every centre, and covariances that know of their neighbours'.
//!
//! M. Brand, *Charting a Manifold* (NIPS 2002), section 3, equations 1–3: a Gaussian per centre μ_i under a prior that
//! penalises the cross entropy of neighbouring Gaussians, with co-locality m_i(·) = exp(−|· − μ_i|² / 2σ_i²), σ_i = r_i / 2.
//! Its maximum solves, for all Σ_i at once,
//!
//! (Σ_n m_i(y_n) + Σ_{j≠i} m_i(μ_j)) Σ_i = Σ_n m_i(y_n) (y_n − μ_i)(y_n − μ_i)ᵀ + Σ_{j≠i} m_i(μ_j) ((μ_j − μ_i)(μ_j − μ_i)ᵀ + Σ_j).
//!
//! Differs: r_i is the distance to a given neighbour of each centre, not one radius for all. The data are too uneven.

use faer::Mat;
use faer::linalg::solvers::Solve;
use rayon::prelude::*;

use super::ChartingError;
use super::vector::squared_distance;

/// m_i: what each point and each other centre counts at a centre.
pub(super) struct CoLocality {
    /// \[centres, points\].
    of_points: Vec<Vec<f64>>,
    /// \[centres, centres\], 0 on the diagonal.
    of_centres: Vec<Vec<f64>>,
}

impl CoLocality {
    /// With σ_i half the distance to the `neighbours`-th nearest of the other points.
    pub fn new(points: &[Vec<f64>], centres: &[Vec<f64>], neighbours: usize) -> Result<Self, ChartingError> {
        let farthest = points.iter().map(|point| squared_distance(point, &points[0])).fold(0.0, f64::max);
        if !(farthest.is_finite() && farthest > 0.0) {
            return Err(ChartingError::NoSpread);
        }
        let smallest = 1e-12 * farthest;
        let around = |centre: &Vec<f64>| {
            let squared: Vec<f64> = points.iter().map(|point| squared_distance(point, centre)).collect();
            let mut sorted = squared.clone();
            sorted.sort_unstable_by(f64::total_cmp);
            // The centre is the first of the points.
            let radius = sorted[neighbours.clamp(1, sorted.len() - 1)].max(smallest);
            let kernel = |squared: f64| (-2.0 * squared / radius).exp();
            let of_points = squared.into_iter().map(kernel).collect();
            let of_centres = |other: &Vec<f64>| kernel(squared_distance(other, centre));
            (of_points, centres.iter().map(of_centres).collect::<Vec<f64>>())
        };
        let (of_points, mut of_centres): (Vec<_>, Vec<Vec<f64>>) = centres.par_iter().map(around).unzip();
        of_centres.iter_mut().enumerate().for_each(|(i, row)| row[i] = 0.0);
        Ok(Self { of_points, of_centres })
    }

    fn total(&self, i: usize) -> f64 {
        self.of_points[i].iter().sum::<f64>() + self.of_centres[i].iter().sum::<f64>()
    }
}

/// The covariances of all centres, \[dimensions, dimensions\] each.
pub(super) fn covariances(points: &[Vec<f64>], centres: &[Vec<f64>], near: &CoLocality) -> Vec<Mat<f64>> {
    let (count, dim) = (centres.len(), points[0].len());
    let scatters: Vec<Vec<f64>> = (0..count)
        .into_par_iter()
        .map(|i| {
            let of_points = points.iter().zip(&near.of_points[i]);
            let of_centres = centres.iter().zip(&near.of_centres[i]);
            scatter(&centres[i], of_points.chain(of_centres))
        })
        .collect();
    // The matrix is strictly diagonally dominant with negative entries aside: its inverse is nowhere negative, and so
    // every covariance is positive semidefinite.
    let coupling = Mat::from_fn(count, count, |i, j| if i == j { near.total(i) } else { -near.of_centres[i][j] });
    let scatters = Mat::from_fn(count, dim * (dim + 1) / 2, |i, entry| scatters[i][entry]);
    let solved = coupling.partial_piv_lu().solve(scatters);
    let entry = |a: usize, b: usize| a.max(b) * (a.max(b) + 1) / 2 + a.min(b);
    (0..count).map(|i| Mat::from_fn(dim, dim, |a, b| solved[(i, entry(a, b))])).collect()
}

/// Σ weight · (point − centre)(point − centre)ᵀ, the lower triangle row by row.
fn scatter<'a>(centre: &[f64], weighted: impl Iterator<Item = (&'a Vec<f64>, &'a f64)>) -> Vec<f64> {
    let dim = centre.len();
    let mut sum = vec![0.0; dim * (dim + 1) / 2];
    let mut offset = vec![0.0; dim];
    for (point, &weight) in weighted.filter(|(_, weight)| **weight > 1e-300) {
        offset.iter_mut().zip(point.iter().zip(centre)).for_each(|(o, (p, c))| *o = p - c);
        let mut start = 0;
        for (a, own) in offset.iter().enumerate() {
            let scaled = weight * own;
            for (sum, b) in sum[start..=start + a].iter_mut().zip(&offset) {
                *sum += scaled * b;
            }
            start += a + 1;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use faer::Side;
    use rand::RngExt as _;

    use super::super::known::swiss_roll;
    use super::*;
    use crate::nbrdf::fit::generator;

    #[test]
    fn covariances_solve_the_coupled_equations_and_have_no_negative_variance() {
        let points = swiss_roll(60, 0.3, 1).points;
        let near = CoLocality::new(&points, &points, 8).unwrap();
        let solved = covariances(&points, &points, &near);
        for (i, (centre, found)) in points.iter().zip(&solved).enumerate() {
            let mut right = Mat::<f64>::zeros(3, 3);
            for (j, (point, neighbour)) in points.iter().zip(&solved).enumerate() {
                let (own, other) = (near.of_points[i][j], near.of_centres[i][j]);
                for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
                    let product = (point[a] - centre[a]) * (point[b] - centre[b]);
                    right[(a, b)] += (own + other) * product + other * neighbour[(a, b)];
                }
            }
            let left = found * near.total(i);
            assert!((left - &right).norm_max() < 1e-9 * right.norm_max(), "chart {i}");
            let variances = found.self_adjoint_eigenvalues(Side::Lower).unwrap();
            assert!(variances[0] > 0.0, "{variances:?}");
        }
    }

    #[test]
    fn charts_of_a_noisy_plane_tilt_less_for_knowing_their_neighbours() {
        let mut random = generator(9, 3);
        let mut random = || random.random::<f64>();
        let points: Vec<_> = (0..150).map(|_| vec![10.0 * random(), 10.0 * random(), 1.4 * random() - 0.7]).collect();
        let near = CoLocality::new(&points, &points, 8).unwrap();
        // Mean squared sine of the angle between the direction of least variance and the plane's normal.
        let tilt = |covariances: &[Mat<f64>]| -> f64 {
            let of = |c: &Mat<f64>| 1.0 - c.self_adjoint_eigen(Side::Lower).unwrap().U()[(2, 0)].powi(2);
            covariances.iter().map(of).sum::<f64>() / covariances.len() as f64
        };
        let alone = |i: usize| {
            let sum = scatter(&points[i], points.iter().zip(&near.of_points[i]));
            Mat::from_fn(3, 3, |a, b| sum[a.max(b) * (a.max(b) + 1) / 2 + a.min(b)])
        };
        let alone = tilt(&(0..150).map(alone).collect::<Vec<_>>());
        let coupled = tilt(&covariances(&points, &points, &near));
        assert!(coupled < 0.7 * alone, "alone {alone}, coupled {coupled}");
    }

    #[test]
    fn points_in_one_place_have_no_charts() {
        let points = vec![vec![1.0, 2.0]; 5];
        assert!(matches!(CoLocality::new(&points, &points, 2), Err(ChartingError::NoSpread)));
    }
}
