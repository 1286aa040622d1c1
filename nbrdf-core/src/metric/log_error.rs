//! `log_error`: the loss networks are fitted with.
//!
//! Mean over rus32k and channels of |ln(1 + f cos θ_i) − ln(1 + g cos θ_i)|; A. Sztrajman et al., *Neural BRDF
//! Representation and Importance Sampling* (2021), doi 10.1111/cgf.14335, section 3.1. Emphasises highlights.

use std::sync::OnceLock;

use super::Metric;
use crate::{
    Brdf, Directions, Rgb,
    sampling::{evaluate, even_directions, rus32k},
};

/// The metric `log_error`; 0 is best.
#[derive(Clone, Copy, Debug, Default)]
pub struct LogError;

impl Metric for LogError {
    fn name(&self) -> &'static str {
        "log_error"
    }

    fn distance(&self, reference: &dyn Brdf, other: &dyn Brdf) -> f64 {
        log_error(rus32k(), &evaluate(reference, rus32k()), &evaluate(other, rus32k()))
    }
}

/// `log_error` of values already at hand: reflectances \[1/sr\] of both materials at each pair of `at`.
///
/// # Panics
/// If the slices differ in length (a bug of the caller).
pub fn log_error(at: &[Directions], reference: &[Rgb], other: &[Rgb]) -> f64 {
    mean_log_ratio(1.0, at, reference, other)
}

/// About [`LogError`]'s distance, from 1024 directions that are none of its own: what is known of a code's error when
/// the code is made.
pub fn log_error_estimate(reference: &dyn Brdf, other: &dyn Brdf) -> f64 {
    static PLACES: OnceLock<Vec<Directions>> = OnceLock::new();
    let at = PLACES.get_or_init(|| even_directions().take(1024).collect());
    log_error(at, &evaluate(reference, at), &evaluate(other, at))
}

/// Mean |ln(offset + f cos θ_i) − ln(offset + g cos θ_i)| over pairs and channels; 0 for no pairs.
///
/// One logarithm of a ratio instead of two: in f64 the difference is far below the f32 of the values.
pub(super) fn mean_log_ratio(offset: f64, at: &[Directions], reference: &[Rgb], other: &[Rgb]) -> f64 {
    assert!(at.len() == reference.len() && at.len() == other.len(), "one value per pair of directions");
    let mut sum = 0.0;
    for ((at, f), g) in at.iter().zip(reference).zip(other) {
        let cos = f64::from(at.light.z);
        for channel in 0..3 {
            let f = offset + f64::from(f[channel]) * cos;
            let g = offset + f64::from(g[channel]) * cos;
            sum += (f / g).ln().abs();
        }
    }
    sum / (3 * at.len()).max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::lambert::Lambert;

    #[test]
    fn a_material_is_at_distance_zero_from_itself() {
        let grey = Lambert { albedo: Rgb::splat(0.5) };
        assert_eq!(LogError.distance(&grey, &grey), 0.0);
    }

    #[test]
    fn black_against_e_minus_one_at_normal_incidence_is_one() {
        let at = [Directions::from_angles(0.0, 0.0, 0.0, 0.0)];
        let bright = [Rgb::splat(std::f32::consts::E - 1.0)];
        assert!((log_error(&at, &[Rgb::BLACK], &bright) - 1.0).abs() < 1e-6);
    }
}
