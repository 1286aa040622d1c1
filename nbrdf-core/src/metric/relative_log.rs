//! `relative_log`: the logarithmic error that also sees dark materials.
//!
//! Mean over rus32k and channels of |ln(f cos θ_i + 10⁻³) − ln(g cos θ_i + 10⁻³)|: roughly a relative error, so a
//! black plastic counts as much as a white one, and of the direction-space errors the one closest to human scores.

use super::{Metric, log_error::mean_log_ratio};
use crate::{
    Brdf, Directions, Rgb,
    sampling::{evaluate, rus32k},
};

/// What is added before the logarithm \[1/sr\]: below it, differences count as absolute ones.
const OFFSET: f64 = 1e-3;

/// The metric `relative_log`; 0 is best.
#[derive(Clone, Copy, Debug, Default)]
pub struct RelativeLog;

impl Metric for RelativeLog {
    fn name(&self) -> &'static str {
        "relative_log"
    }

    fn distance(&self, reference: &dyn Brdf, other: &dyn Brdf) -> f64 {
        relative_log(rus32k(), &evaluate(reference, rus32k()), &evaluate(other, rus32k()))
    }
}

/// `relative_log` of values already at hand: reflectances \[1/sr\] of both materials at each pair of `at`.
///
/// # Panics
/// If the slices differ in length (a bug of the caller).
pub fn relative_log(at: &[Directions], reference: &[Rgb], other: &[Rgb]) -> f64 {
    mean_log_ratio(OFFSET, at, reference, other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{brdf::lambert::Lambert, metric::LogError};

    #[test]
    fn dark_materials_count_more_than_in_log_error() {
        let lambert = |albedo: f32| Lambert { albedo: Rgb::splat(albedo) };
        let (black, blacker) = (lambert(0.02), lambert(0.01));
        let factor = RelativeLog.distance(&black, &blacker) / LogError.distance(&black, &blacker);
        assert!(factor > 50.0, "{factor}");
    }

    #[test]
    fn halving_a_bright_material_costs_nearly_ln_two() {
        let at = [Directions::from_angles(0.0, 0.0, 0.0, 0.0)];
        let error = relative_log(&at, &[Rgb::splat(10.0)], &[Rgb::splat(5.0)]);
        assert!((error - 2.0_f64.ln()).abs() < 2e-4, "{error}");
    }
}
