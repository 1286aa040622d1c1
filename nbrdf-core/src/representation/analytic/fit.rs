//! The best of several descents.

use std::convert::Infallible;

use rayon::prelude::*;

use crate::least_squares::{Residuals, Steps, minimize};

/// Steps from every start, and those more from the best.
const TRIED: usize = 12;
const REFINED: usize = 60;
/// How many of the starts are followed to the end.
const FOLLOWED: usize = 2;
/// Offset of numerical derivatives, relative to the numbers' size.
const OFFSET: f32 = 1e-3;

/// Parameters to be found, by the values they give.
pub(super) struct Problem<'a, F> {
    /// ln(1 + f cos θ_i) of several codes at all places.
    pub logs: F,
    /// The same of the material.
    pub target: &'a [f32],
    /// What each counts.
    pub weights: &'a [f32],
}

impl<F: Fn(&[Vec<f32>]) -> Vec<Vec<f32>> + Sync> Problem<'_, F> {
    /// The best numbers that are reached from these starts, of which there is at least one.
    pub fn solve(&self, starts: &[Vec<f32>]) -> Vec<f32> {
        let walk = |start: &Vec<f32>, steps| {
            let Ok(end) = minimize(self, start, Steps { steps, offset: OFFSET });
            let Ok(residual) = self.residuals(std::slice::from_ref(&end));
            (self.loss(&residual[0]), end)
        };
        let mut tried: Vec<_> = starts.par_iter().map(|start| walk(start, TRIED)).collect();
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        tried.truncate(FOLLOWED);
        let ends = tried.par_iter().map(|(_, start)| walk(start, REFINED)).collect::<Vec<_>>();
        let best = ends.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, end)| end).unwrap_or_default()
    }
}

impl<F: Fn(&[Vec<f32>]) -> Vec<Vec<f32>> + Sync> Residuals for Problem<'_, F> {
    type Error = Infallible;

    fn residuals(&self, points: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, Infallible> {
        let mut all = (self.logs)(points);
        for logs in &mut all {
            logs.iter_mut().zip(self.target).for_each(|(own, target)| *own -= target);
        }
        Ok(all)
    }

    /// Of the mean distance as a weighted mean square (P. Holland, R. Welsch, *Robust Regression using Iteratively
    /// Reweighted Least-Squares*, 1977), blunt where a residual is far below what is typical.
    fn weights(&self, residual: &[f32]) -> Vec<f32> {
        let typical = self.loss(residual) as f32;
        let blunt = (0.1 * typical).max(1e-6);
        self.weights.iter().zip(residual).map(|(weight, r)| weight / r.abs().max(blunt)).collect()
    }

    fn loss(&self, residual: &[f32]) -> f64 {
        self.weights.iter().zip(residual).map(|(weight, r)| f64::from(*weight) * f64::from(r.abs())).sum()
    }
}
