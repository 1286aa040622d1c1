//! How close materials come back from few measurements: coefficients, chosen directions, pictures of a sphere.

pub mod combination;
pub mod directions;
pub mod images;

use nbrdf_core::metric::{log_error, relative_log};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Material, Rgb};
use serde::Serialize;

/// The materials that are measured, with their values over rus32k.
pub struct Targets<'a> {
    /// The materials.
    pub materials: Vec<&'a Material>,
    values: Vec<Vec<Rgb>>,
}

/// `log_error` and `relative_log` of one reconstruction, or their means.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Errors {
    /// Weighs highlights.
    pub log_error: f64,
    /// Weighs dark materials.
    pub relative_log: f64,
}

/// A figure over random draws.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Draws {
    /// Mean over draws.
    pub mean: f64,
    /// Standard deviation over draws; 0 for a single one.
    pub sd: f64,
    /// Of the worst draw.
    pub worst: f64,
}

impl<'a> Targets<'a> {
    /// Evaluates the materials.
    pub fn new(materials: Vec<&'a Material>) -> Self {
        let values = materials.iter().map(|material| evaluate(material.brdf.as_ref(), rus32k())).collect();
        Self { materials, values }
    }

    /// Errors of values over rus32k against the material of that number.
    fn errors(&self, material: usize, values: &[Rgb]) -> Errors {
        let reference = &self.values[material];
        Errors {
            log_error: log_error(rus32k(), reference, values),
            relative_log: relative_log(rus32k(), reference, values),
        }
    }
}

impl Errors {
    /// The mean of many; 0 of none.
    pub fn mean(all: &[Self]) -> Self {
        let mean = |value: fn(&Self) -> f64| all.iter().map(value).sum::<f64>() / all.len().max(1) as f64;
        Self { log_error: mean(|errors| errors.log_error), relative_log: mean(|errors| errors.relative_log) }
    }
}

impl Draws {
    /// Of one figure for each draw; larger is worse.
    pub fn of(figures: impl IntoIterator<Item = f64>) -> Self {
        let figures: Vec<f64> = figures.into_iter().collect();
        let count = figures.len().max(1) as f64;
        let mean = figures.iter().sum::<f64>() / count;
        let squares: f64 = figures.iter().map(|figure| (figure - mean).powi(2)).sum();
        let sd = (squares / (count - 1.0).max(1.0)).sqrt();
        Self { mean, sd, worst: figures.into_iter().fold(f64::NEG_INFINITY, f64::max) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_told_by_mean_spread_and_the_worst() {
        let Draws { mean, sd, worst } = Draws::of([1.0, 2.0, 6.0]);
        assert!((mean - 3.0).abs() < 1e-12 && (sd - 7f64.sqrt()).abs() < 1e-12 && worst == 6.0);
        assert_eq!(Draws::of([4.0]).sd, 0.0);
    }
}
