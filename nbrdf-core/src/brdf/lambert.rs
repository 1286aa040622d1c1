//! Perfectly diffuse reflection: f = albedo / π (J. H. Lambert, *Photometria*, 1760).

use std::f32::consts::FRAC_1_PI;

use crate::{Brdf, Directions, Rgb};

/// The same reflectance in all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert {
    /// Share of the light that is reflected, per channel, 0..1.
    pub albedo: Rgb,
}

impl Brdf for Lambert {
    fn eval(&self, at: Directions) -> Rgb {
        if at.is_above() { self.albedo * FRAC_1_PI } else { Rgb::BLACK }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_reflected_below_either_horizon() {
        let white = Lambert { albedo: Rgb::splat(1.0) };
        let above = Directions::from_angles(0.3, 0.0, 1.2, 2.0);
        let below = Directions::from_angles(1.8, 0.0, 0.2, 1.0);
        assert_eq!(white.eval(above), Rgb::splat(FRAC_1_PI));
        assert_eq!(white.eval(below), Rgb::BLACK);
        assert_eq!(white.eval(below.swapped()), Rgb::BLACK);
    }
}
