//! Linear least squares seen through its singular values: how well posed a system is, and its answer, plain or damped.
//!
//! G. Golub, C. Van Loan, *Matrix Computations* (4th edition, 2013), sections 5.5 (minimum norm) and 6.1.4 (ridge, after
//! Tikhonov 1963). A system of many rows comes as its Gram matrix, summed elsewhere; in f64 that tells condition numbers
//! up to 10⁷, far beyond what data of f32 can hold.

use faer::{Mat, Side};

/// Singular values below this share of the largest, per unknown, are rounding.
const NEGLIGIBLE: f64 = f64::EPSILON;

/// A matrix A, prepared for min |A x − b|² + damping · |x|².
#[derive(Clone, Debug)]
pub struct LinearSystem {
    /// Singular values, falling.
    values: Vec<f64>,
    /// Right singular vectors \[unknowns, values\].
    right: Mat<f64>,
    /// Singular values up to this one are rounding.
    negligible: f64,
}

/// The singular values did not converge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the system has no singular values: are all values finite?")]
pub struct NoConvergence;

impl LinearSystem {
    /// From the matrix itself \[equations, unknowns\].
    pub fn of(matrix: &Mat<f64>) -> Result<Self, NoConvergence> {
        all_finite(matrix)?;
        let svd = matrix.thin_svd().map_err(|_| NoConvergence)?;
        let values: Vec<f64> = svd.S().column_vector().iter().copied().collect();
        let largest = values.first().copied().unwrap_or(0.0);
        let negligible = largest * NEGLIGIBLE * matrix.nrows().max(matrix.ncols()) as f64;
        Ok(Self { values, right: svd.V().to_owned(), negligible })
    }

    /// From AᵀA \[unknowns, unknowns\] of a matrix with at least as many rows as unknowns.
    pub fn of_gram(gram: &Mat<f64>) -> Result<Self, NoConvergence> {
        all_finite(gram)?;
        let eigen = gram.self_adjoint_eigen(Side::Lower).map_err(|_| NoConvergence)?;
        let n = gram.nrows();
        // faer sorts eigenvalues upwards
        let squares: Vec<f64> = eigen.S().column_vector().iter().rev().map(|square| square.max(0.0)).collect();
        let negligible = (squares.first().copied().unwrap_or(0.0) * NEGLIGIBLE * n as f64).sqrt();
        let right = Mat::from_fn(n, n, |i, j| eigen.U()[(i, n - 1 - j)]);
        Ok(Self { values: squares.into_iter().map(f64::sqrt).collect(), right, negligible })
    }

    /// Largest over smallest singular value; infinite where the rank is below the shorter side, 1 for an empty
    /// matrix.
    pub fn condition(&self) -> f64 {
        match (self.values.first(), self.values.last()) {
            (Some(_), Some(&smallest)) if smallest <= self.negligible => f64::INFINITY,
            (Some(largest), Some(smallest)) => largest / smallest,
            _ => 1.0,
        }
    }

    /// The x that minimises |A x − b|² + damping · |x|² from Aᵀb \[unknowns\]; without damping, the shortest x of the least
    /// |A x − b|.
    ///
    /// # Panics
    /// If there is not one number per unknown (a bug of the caller).
    pub fn solve(&self, slope: &[f64], damping: f64) -> Vec<f64> {
        assert_eq!(slope.len(), self.right.nrows(), "one number per unknown");
        let mut solution = vec![0.0; slope.len()];
        for (column, &value) in self.values.iter().enumerate() {
            if value <= self.negligible {
                continue;
            }
            let along: f64 = slope.iter().enumerate().map(|(i, slope)| self.right[(i, column)] * slope).sum();
            let amount = along / (value * value + damping);
            solution.iter_mut().enumerate().for_each(|(i, x)| *x += amount * self.right[(i, column)]);
        }
        solution
    }
}

fn all_finite(matrix: &Mat<f64>) -> Result<(), NoConvergence> {
    let columns = (0..matrix.ncols()).flat_map(|j| (0..matrix.nrows()).map(move |i| (i, j)));
    if columns.into_iter().all(|at| matrix[at].is_finite()) { Ok(()) } else { Err(NoConvergence) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The polynomials 1, x, x² at five places: A, and Aᵀb for b = 1 + 2 x − x².
    fn parabola() -> (Mat<f64>, Vec<f64>) {
        let matrix = Mat::from_fn(5, 3, |i, j| (0.5 * i as f64).powi(j as i32));
        let exact = [1.0, 2.0, -1.0];
        let b = |i: usize| (0..3).map(|j| matrix[(i, j)] * exact[j]).sum::<f64>();
        let slope = (0..3).map(|j| (0..5).map(|i| matrix[(i, j)] * b(i)).sum()).collect();
        (matrix, slope)
    }

    #[test]
    fn a_plain_answer_is_exact_and_damping_shortens_it() {
        let (matrix, slope) = parabola();
        let systems =
            [LinearSystem::of(&matrix).unwrap(), LinearSystem::of_gram(&(matrix.transpose() * &matrix)).unwrap()];
        for system in systems {
            let plain = system.solve(&slope, 0.0);
            assert!(plain.iter().zip([1.0, 2.0, -1.0]).all(|(x, exact)| (x - exact).abs() < 1e-9), "{plain:?}");
            let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
            assert!(length(&system.solve(&slope, 1.0)) < 0.9 * length(&plain));
        }
    }

    #[test]
    fn columns_that_depend_on_each_other_have_no_condition_and_share_the_answer() {
        let system = LinearSystem::of(&Mat::from_fn(4, 2, |i, _| i as f64)).unwrap();
        assert!(system.condition().is_infinite());
        let shared = system.solve(&[28.0, 28.0], 0.0);
        assert!(shared.iter().all(|x| (x - 1.0).abs() < 1e-9), "{shared:?}");
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        for odd in [f64::NAN, f64::INFINITY] {
            let matrix = Mat::from_fn(2, 2, |i, j| if i > j { odd } else { 1.0 });
            assert!(LinearSystem::of(&matrix).is_err() && LinearSystem::of_gram(&matrix).is_err());
        }
        assert_eq!(LinearSystem::of(&Mat::zeros(0, 0)).unwrap().condition(), 1.0);
    }
}
