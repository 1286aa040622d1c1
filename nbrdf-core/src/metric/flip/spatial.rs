//! What the eye resolves: contrast sensitivity filters on luminance and two opponent colours (section 4.1.1).

use std::f64::consts::PI;

use super::{
    PIXELS_PER_DEGREE,
    color::{Lab, hunt_lab_from_linear, linear_from_ycxcz},
};
use crate::metric::plane::Plane;

/// (a, b) of the Gaussians a √(π/b) exp(−π² x² / b) that make up one filter, x in degrees (table 1).
type Sensitivity = &'static [(f64, f64)];
const ACHROMATIC: Sensitivity = &[(1.0, 0.0047)];
const RED_GREEN: Sensitivity = &[(1.0, 0.0053)];
const BLUE_YELLOW: Sensitivity = &[(34.1, 0.04), (13.5, 0.025)];
/// The widest b: three of its standard deviations are the radius of all filters.
const WIDEST: f64 = 0.04;
/// Smaller weights change nothing in f64; leaving them out makes the narrow filters short.
const NEGLIGIBLE: f64 = 1e-15;

/// Filtered, clipped to 0..1 in linear RGB, and taken to Hunt-adjusted CIELAB.
pub(super) fn filtered(opponent: &[Plane; 3]) -> Vec<Lab> {
    let y = filter(&opponent[0], ACHROMATIC);
    let cx = filter(&opponent[1], RED_GREEN);
    let cz = filter(&opponent[2], BLUE_YELLOW);
    let pixels = y.values.iter().zip(&cx.values).zip(&cz.values);
    pixels
        .map(|((&y, &cx), &cz)| hunt_lab_from_linear(linear_from_ycxcz([y, cx, cz]).map(|v| v.clamp(0.0, 1.0))))
        .collect()
}

/// The sum of Gaussians, normalised as a whole; each Gaussian is separable.
fn filter(plane: &Plane, sensitivity: Sensitivity) -> Plane {
    let kernels: Vec<(f64, Vec<f64>)> =
        sensitivity.iter().map(|&(a, b)| (a * (PI / b).sqrt(), gaussian_of_degrees(b))).collect();
    let volume = |(scale, kernel): &(f64, Vec<f64>)| scale * kernel.iter().sum::<f64>().powi(2);
    let total: f64 = kernels.iter().map(volume).sum();
    let mut sum: Option<Plane> = None;
    for (scale, kernel) in kernels {
        let rows: Vec<f64> = kernel.iter().map(|weight| weight * scale / total).collect();
        let part = plane.along_rows(&rows).along_columns(&kernel);
        sum = Some(sum.map_or_else(|| part.clone(), |sum| sum.zip(&part, |a, b| a + b)));
    }
    sum.unwrap_or_else(|| plane.clone())
}

fn gaussian_of_degrees(b: f64) -> Vec<f64> {
    let radius = (3.0 * (WIDEST / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
    let weight = |x: i32| (-(PI * f64::from(x) / PIXELS_PER_DEGREE).powi(2) / b).exp();
    (-radius..=radius).map(weight).filter(|&weight| weight > NEGLIGIBLE).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_keep_a_constant() {
        let flat = Plane { width: 6, height: 5, values: vec![42.0; 30] };
        for sensitivity in [ACHROMATIC, RED_GREEN, BLUE_YELLOW] {
            assert!(filter(&flat, sensitivity).values.iter().all(|v| (v - 42.0).abs() < 1e-12));
        }
    }

    #[test]
    fn the_widest_filter_spans_21_pixels() {
        assert_eq!(gaussian_of_degrees(WIDEST).len(), 21);
    }
}
