//! Levenberg–Marquardt for a few unknowns and many residuals, with the problem's own derivatives or numerical ones.
//!
//! J. Nocedal, S. Wright, *Numerical Optimization* (2006), section 10.3; damping scaled by the diagonal (Marquardt 1963).

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

/// A problem: unknowns, and how to compare them with the target.
pub trait Residuals {
    /// Why evaluation can fail.
    type Error;
    /// own − target for each of several points, all at once.
    fn residuals(&self, points: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, Self::Error>;
    /// One column of derivatives per unknown at `point`; `None` where the problem has none of its own.
    fn jacobian(&self, _point: &[f32]) -> Result<Option<Vec<Vec<f32>>>, Self::Error> {
        Ok(None)
    }
    /// Weight of every squared residual (iteratively reweighted, for losses that are no squares).
    fn weights(&self, residual: &[f32]) -> Vec<f32>;
    /// The loss itself, which decides whether a step is taken.
    fn loss(&self, residual: &[f32]) -> f64;
}

/// How far to go.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// Steps that lower the loss.
    pub steps: usize,
    /// Offset for numerical derivatives, relative to each unknown's typical size.
    pub offset: f32,
}

/// Walks downhill from `start`; never returns a point worse than it.
pub fn minimize<P: Residuals>(problem: &P, start: &[f32], options: Steps) -> Result<Vec<f32>, P::Error> {
    let mut point = start.to_vec();
    let mut residual = first(problem.residuals(std::slice::from_ref(&point))?);
    let mut loss = problem.loss(&residual);
    let mut damping = 1e-2;
    for _ in 0..options.steps {
        let jacobian = match problem.jacobian(&point)? {
            Some(jacobian) => jacobian,
            None => differences(problem, &point, &residual, options.offset)?,
        };
        let weights = problem.weights(&residual);
        let (normal, slope) = normal_equations(&jacobian, &residual, &weights);
        let mut improved = false;
        for _ in 0..6 {
            let Some(step) = damped_step(&normal, &slope, damping) else { break };
            let next: Vec<f32> = point.iter().zip(&step).map(|(p, s)| p - *s as f32).collect();
            // A step to where nothing can be evaluated is a step too far.
            let tried = problem.residuals(std::slice::from_ref(&next)).map(first);
            let tried = tried.map(|residual| (problem.loss(&residual), residual));
            if let Ok((next_loss, next_residual)) = tried
                && next_loss < loss
            {
                (point, residual, loss) = (next, next_residual, next_loss);
                damping = (damping * 0.3).max(1e-6);
                improved = true;
                break;
            }
            damping *= 4.0;
        }
        if !improved {
            break;
        }
    }
    Ok(point)
}

fn first(mut all: Vec<Vec<f32>>) -> Vec<f32> {
    all.swap_remove(0)
}

/// One column of derivatives per unknown, by forward differences.
fn differences<P: Residuals>(
    problem: &P,
    point: &[f32],
    residual: &[f32],
    offset: f32,
) -> Result<Vec<Vec<f32>>, P::Error> {
    let typical = (point.iter().map(|v| v * v).sum::<f32>() / point.len() as f32).sqrt().max(1e-3);
    let offset = offset * typical;
    let nudged = |i: usize| {
        let mut point = point.to_vec();
        point[i] += offset;
        point
    };
    let points: Vec<_> = (0..point.len()).map(nudged).collect();
    let mut columns = problem.residuals(&points)?;
    for column in &mut columns {
        column.iter_mut().zip(residual).for_each(|(v, r)| *v = (*v - r) / offset);
    }
    Ok(columns)
}

/// Jᵀ W J and Jᵀ W r.
fn normal_equations(jacobian: &[Vec<f32>], residual: &[f32], weights: &[f32]) -> (Mat<f64>, Vec<f64>) {
    use rayon::prelude::*;
    let weighted: Vec<Vec<f32>> =
        jacobian.par_iter().map(|column| column.iter().zip(weights).map(|(v, w)| v * w).collect()).collect();
    let dot = |a: &[f32], b: &[f32]| -> f64 {
        a.chunks(64).zip(b.chunks(64)).map(|(a, b)| f64::from(a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>())).sum()
    };
    let rows: Vec<Vec<f64>> =
        weighted.par_iter().enumerate().map(|(i, row)| jacobian[..=i].iter().map(|c| dot(row, c)).collect()).collect();
    let normal = Mat::from_fn(jacobian.len(), jacobian.len(), |i, j| rows[i.max(j)][i.min(j)]);
    (normal, weighted.iter().map(|row| dot(row, residual)).collect())
}

/// (JᵀWJ + damping · (diagonal + a little of its mean))⁻¹ JᵀWr.
pub(crate) fn damped_step(normal: &Mat<f64>, slope: &[f64], damping: f64) -> Option<Vec<f64>> {
    let n = slope.len();
    let mean = (0..n).map(|i| normal[(i, i)]).sum::<f64>() / n as f64;
    let damped = Mat::from_fn(n, n, |i, j| {
        let extra = if i == j { damping * (normal[(i, i)] + 1e-2 * mean) + 1e-12 } else { 0.0 };
        normal[(i, j)] + extra
    });
    let factor = Llt::new(damped.as_ref(), Side::Lower).ok()?;
    let step = factor.solve(Mat::from_fn(n, 1, |i, _| slope[i]));
    (0..n).map(|i| step[(i, 0)]).map(|v| v.is_finite().then_some(v)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rosenbrock's valley as residuals: (10 (y − x²), 1 − x), minimum at (1, 1).
    struct Valley;

    impl Residuals for Valley {
        type Error = std::convert::Infallible;

        fn residuals(&self, points: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, Self::Error> {
            Ok(points.iter().map(|p| vec![10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]]).collect())
        }

        fn weights(&self, residual: &[f32]) -> Vec<f32> {
            vec![1.0; residual.len()]
        }

        fn loss(&self, residual: &[f32]) -> f64 {
            residual.iter().map(|r| f64::from(r * r)).sum()
        }
    }

    #[test]
    fn the_valley_is_walked_to_its_end() {
        let Ok(end) = minimize(&Valley, &[-1.2, 1.0], Steps { steps: 60, offset: 1e-3 });
        assert!((end[0] - 1.0).abs() < 1e-2 && (end[1] - 1.0).abs() < 2e-2, "{end:?}");
    }

    #[test]
    fn no_step_leaves_the_start_alone() {
        let Ok(end) = minimize(&Valley, &[0.3, 0.4], Steps { steps: 0, offset: 1e-3 });
        assert_eq!(end, [0.3, 0.4]);
    }
}
