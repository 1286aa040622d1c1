//! A box of (θ_half, θ_diff, φ_diff), and the network inputs over it.

use std::f64::consts::{FRAC_PI_2, PI};

use super::affine::Affine;
use crate::nbrdf::INPUTS;

/// How far computed directions may seem to be below the horizon: the largest slant of vectors whose lengths are within
/// 10⁻⁶ of 1 and whose sum is not shorter than `OPPOSITE` = 10⁻³, (|l|² − |v|²) / |l + v| < 4·10⁻³.
const BELOW: f64 = 5e-3;

/// Centre and half width \[rad\] along θ_half, θ_diff, φ_diff.
#[derive(Clone, Copy, Debug)]
pub(super) struct Region {
    centre: [f64; 3],
    half: [f64; 3],
}

impl Region {
    /// All pairs of directions, and some below the horizon.
    pub const WHOLE: Self =
        Self { centre: [0.5 * FRAC_PI_2, 0.5 * FRAC_PI_2, 0.0], half: [0.5 * FRAC_PI_2, 0.5 * FRAC_PI_2, PI] };

    /// Halved along one angle.
    pub fn halves(&self, angle: usize) -> [Self; 2] {
        [-0.5, 0.5].map(|side| {
            let mut part = *self;
            part.centre[angle] += side * self.half[angle];
            part.half[angle] *= 0.5;
            part
        })
    }

    /// Half width along an angle \[rad\].
    pub const fn half_width(&self, angle: usize) -> f64 {
        self.half[angle]
    }

    /// Whether light and view can both seem to be above the surface: |sin θ_h sin θ_d cos φ_d| < cos θ_h cos θ_d,
    /// give or take, somewhere.
    pub fn is_valid_somewhere(&self) -> bool {
        let [low_h, low_d] = [0, 1].map(|axis| (self.centre[axis] - self.half[axis]).max(0.0));
        low_h.sin() * low_d.sin() * self.smallest_cosine() < low_h.cos() * low_d.cos() + BELOW
    }

    /// Whether they are at the centre.
    pub fn centre_is_valid(&self) -> bool {
        let [h, d, p] = self.centre;
        h.sin() * d.sin() * p.cos().abs() < h.cos() * d.cos()
    }

    /// Of |cos φ_d| over the region.
    fn smallest_cosine(&self) -> f64 {
        let (low, high) = (self.centre[2] - self.half[2], self.centre[2] + self.half[2]);
        // A zero of the cosine, π/2 + k π, lies inside or not.
        if ((low - FRAC_PI_2) / PI).ceil() <= ((high - FRAC_PI_2) / PI).floor() {
            return 0.0;
        }
        low.cos().abs().min(high.cos().abs())
    }

    /// h.x h.y h.z d.x d.y d.z: value and slope at the centre, and the largest second-order remainder (Taylor).
    pub fn inputs(&self) -> [Affine; INPUTS] {
        let ([sin_h, sin_d, sin_p], [cos_h, cos_d, cos_p]) = (self.centre.map(f64::sin), self.centre.map(f64::cos));
        let [rh, rd, rp] = self.half;
        // Largest values anywhere on the region; all second derivatives are products of these.
        let largest = |value: f64, radius: f64| (value.abs() + radius).min(1.0);
        let (sin_most, cos_most) = (largest(sin_d, rd), largest(cos_d, rd));
        let of_half = |centre: f64, slope: f64| {
            let error = 0.5 * rh * rh * largest(centre, rh);
            Affine { centre, slope: [slope * rh, 0.0, 0.0], error: [error, 0.0, 0.0, 0.0] }
        };
        let across = |along: f64, turned: f64| {
            let both = 0.5 * cos_most * rd * rp;
            let error = [0.0, 0.5 * sin_most * rd * rd + both, 0.5 * sin_most * rp * rp + both, 0.0];
            Affine { centre: sin_d * along, slope: [0.0, cos_d * along * rd, sin_d * turned * rp], error }
        };
        let up =
            Affine { centre: cos_d, slope: [0.0, -sin_d * rd, 0.0], error: [0.0, 0.5 * rd * rd * cos_most, 0.0, 0.0] };
        let none = Affine::constant(0.0);
        [of_half(sin_h, cos_h), none, of_half(cos_h, -sin_h), across(cos_p, -sin_p), across(sin_p, cos_p), up]
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn inputs_never_leave_their_bounds(
            splits in prop::collection::vec((0..3usize, 0..2usize), 0..24), at in [-1.0..1.0f64, -1.0..1.0, -1.0..1.0],
        ) {
            let region = splits.into_iter().fold(Region::WHOLE, |region, (angle, side)| region.halves(angle)[side]);
            let [h, d, p]: [f64; 3] = std::array::from_fn(|axis| region.centre[axis] + at[axis] * region.half[axis]);
            let exact = [h.sin(), 0.0, h.cos(), d.sin() * p.cos(), d.sin() * p.sin(), d.cos()];
            for (bound, exact) in region.inputs().into_iter().zip(exact) {
                let plane = bound.centre + bound.slope.iter().zip(at).map(|(s, t)| s * t).sum::<f64>();
                prop_assert!((plane - exact).abs() <= bound.error.iter().sum::<f64>() + 1e-12, "{bound:?}: {exact}");
                prop_assert!(exact <= bound.upper() + 1e-12);
            }
            let is_valid = h.sin() * d.sin() * p.cos().abs() < h.cos() * d.cos();
            prop_assert!(!is_valid || region.is_valid_somewhere());
        }
    }
}
