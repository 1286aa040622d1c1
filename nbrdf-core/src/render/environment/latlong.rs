//! Pixels of a latitude-longitude map and the directions they stand for.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// A map of `width` × `height` pixels, both at least 1.
///
/// Column edges lie at longitudes λ = π − 2π x / width, λ = atan2(x, z); row edges at polar angles π y / height from +y.
#[derive(Clone, Copy, Debug)]
pub(super) struct LatLong {
    pub(super) width: usize,
    pub(super) height: usize,
}

impl LatLong {
    /// Column and row of the pixel that holds `direction`, which need not be of unit length.
    pub(super) fn pixel(self, direction: DVec3) -> (usize, usize) {
        let u = 0.5 - direction.x.atan2(direction.z) / TAU;
        let v = direction.x.hypot(direction.z).atan2(direction.y) / PI;
        // Rounding may reach the far edge: the last column and row hold it.
        let place = |share: f64, pixels: usize| ((share * pixels as f64) as usize).min(pixels - 1);
        (place(u, self.width), place(v, self.height))
    }

    /// The direction at `within`, \[0, 1)², of a pixel: even in longitude and in cosine, so in solid angle.
    pub(super) fn direction(self, x: usize, y: usize, within: [f64; 2]) -> DVec3 {
        let (sin, cos) = ((0.5 - (x as f64 + within[0]) / self.width as f64) * TAU).sin_cos();
        let (top, bottom) = (self.cos(y), self.cos(y + 1));
        let height = top + (bottom - top) * within[1];
        let radius = (1.0 - height * height).max(0.0).sqrt();
        DVec3::new(radius * sin, height, radius * cos)
    }

    /// Of each pixel in row `y` \[sr\]; all of them together are 4π.
    pub(super) fn solid_angle(self, y: usize) -> f64 {
        TAU / self.width as f64 * (self.cos(y) - self.cos(y + 1))
    }

    /// Cosine of the polar angle at the upper edge of row `y`.
    fn cos(self, y: usize) -> f64 {
        (PI * y as f64 / self.height as f64).cos()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const SHAPE: LatLong = LatLong { width: 16, height: 8 };

    #[test]
    fn the_axes_lie_where_the_convention_says() {
        // Just right of and below an edge between pixels.
        let near = |x, y, z| SHAPE.pixel(DVec3::new(x, y, z) - DVec3::splat(1e-9));
        assert_eq!(near(0.0, 0.0, 1.0), (8, 4), "+z: the centre");
        assert_eq!(SHAPE.pixel(DVec3::new(1.0, -1e-9, -1e-9)), (3, 4), "+x: a quarter from the left");
        assert_eq!(SHAPE.pixel(DVec3::new(-1.0, -1e-9, 1e-9)), (11, 4), "-x: a quarter from the right");
        assert_eq!(SHAPE.pixel(DVec3::new(1e-9, 0.1, -1.0)), (0, 3), "-z: the left end");
        assert_eq!(SHAPE.pixel(DVec3::new(-1e-9, 0.1, -1.0)), (15, 3), "and the right end");
        assert_eq!(SHAPE.pixel(DVec3::Y).1, 0, "+y: the top");
        assert_eq!(SHAPE.pixel(DVec3::NEG_Y).1, 7, "-y: the bottom");
    }

    #[test]
    fn pixels_cover_the_sphere() {
        let sum: f64 = (0..SHAPE.height).map(|y| SHAPE.solid_angle(y) * SHAPE.width as f64).sum();
        assert!((sum - 4.0 * PI).abs() < 1e-12, "{sum}");
    }

    proptest! {
        #[test]
        fn a_direction_of_a_pixel_lies_in_it(
            x in 0..16_usize, y in 0..8_usize, u in 0.001..0.999_f64, v in 0.001..0.999_f64,
        ) {
            let direction = SHAPE.direction(x, y, [u, v]);
            prop_assert!((direction.length() - 1.0).abs() < 1e-12);
            prop_assert_eq!(SHAPE.pixel(direction), (x, y));
        }

        #[test]
        fn every_vector_lies_in_some_pixel(x: f64, y: f64, z: f64) {
            let (x, y) = SHAPE.pixel(DVec3::new(x, y, z));
            prop_assert!(x < 16 && y < 8);
        }
    }
}
