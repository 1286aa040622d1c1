//! Edges and points: what makes a difference stand out (section 4.2).

use super::PIXELS_PER_DEGREE;
use crate::metric::plane::{Plane, gaussian, normalised};

/// Width of the feature detectors in degrees.
const WIDTH: f64 = 0.082;

/// Strength of edges and points at each pixel.
pub(super) struct Features {
    edges: Vec<f64>,
    points: Vec<f64>,
}

impl Features {
    /// From the unfiltered luminance channel Y of YCxCz, −16..100.
    pub(super) fn new(luminance: &Plane) -> Self {
        let sigma = 0.5 * WIDTH * PIXELS_PER_DEGREE;
        let radius = (3.0 * sigma).ceil() as usize;
        let smooth = normalised(gaussian(radius, sigma));
        let [edge, point] = [|x: f64, _: f64| -x, |x: f64, sigma: f64| x * x / (sigma * sigma) - 1.0]
            .map(|shape: fn(f64, f64) -> f64| balanced(radius, sigma, shape));
        let y = Plane { values: luminance.values.iter().map(|y| (y + 16.0) / 116.0).collect(), ..*luminance };
        let smooth_rows = y.along_rows(&smooth);
        let strength = |kernel: &[f64]| {
            let (x, y) = (y.along_rows(kernel).along_columns(&smooth), smooth_rows.along_columns(kernel));
            x.zip(&y, |x, y| (x * x + y * y).sqrt()).values
        };
        Self { edges: strength(&edge), points: strength(&point) }
    }

    /// The larger of the differences in edges and in points, 0..1.
    pub(super) fn difference(&self, other: &Self, pixel: usize) -> f64 {
        let edges = (self.edges[pixel] - other.edges[pixel]).abs();
        let points = (self.points[pixel] - other.points[pixel]).abs();
        edges.max(points) * std::f64::consts::FRAC_1_SQRT_2
    }
}

/// A derivative of the Gaussian whose positive weights sum to 1 and whose negative weights sum to −1.
fn balanced(radius: usize, sigma: f64, shape: fn(f64, f64) -> f64) -> Vec<f64> {
    let position = |i: usize| i as f64 - radius as f64;
    let kernel: Vec<f64> =
        gaussian(radius, sigma).iter().enumerate().map(|(i, g)| shape(position(i), sigma) * g).collect();
    let positive: f64 = kernel.iter().filter(|&&w| w > 0.0).sum();
    let negative: f64 = -kernel.iter().filter(|&&w| w < 0.0).sum::<f64>();
    kernel.iter().map(|&w| w / if w > 0.0 { positive } else { negative }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_image_has_no_features() {
        let flat = Plane { width: 8, height: 8, values: vec![30.0; 64] };
        let features = Features::new(&flat);
        assert!(features.edges.iter().chain(&features.points).all(|v| v.abs() < 1e-12));
    }

    #[test]
    fn a_step_from_black_to_white_is_a_whole_edge() {
        let values = (0..40 * 8).map(|i| if i % 40 < 20 { -16.0 } else { 100.0 }).collect();
        let features = Features::new(&Plane { width: 40, height: 8, values });
        let strongest = features.edges.iter().copied().fold(0.0, f64::max);
        assert!((strongest - 1.0).abs() < 1e-9, "{strongest}");
    }
}
