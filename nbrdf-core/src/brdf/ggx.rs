//! A diffuse base under one GGX lobe: f = k_d/π + D G F / (4 cos θ_i cos θ_o).
//!
//! D and the height-correlated Smith G are those of GGX, F is Schlick's; see [`microfacet`](super::microfacet).
//! The base is not darkened where the lobe reflects, so bright bases may exceed energy 1 at grazing angles.

use std::f32::consts::FRAC_1_PI;

use pulp::Simd;

use super::microfacet::{base_and_lobe, ggx_distribution};
use super::vectors::{self, Formula};
use crate::{Brdf, Directions, Rgb};

/// Smaller α is taken as this: the peak of D, 1/(πα²), stays far from overflow.
const SMOOTHEST: f32 = 1e-3;

/// A diffuse base and a GGX lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// k_d, albedo of the base, 0..1.
    pub diffuse: Rgb,
    /// F₀, reflectance of the lobe at normal incidence, 0..1.
    pub f0: Rgb,
    /// Roughness α, 0.001..1 (smaller is taken as 0.001).
    pub alpha: f32,
}

impl Brdf for Ggx {
    fn eval(&self, at: Directions) -> Rgb {
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let alpha = self.alpha.max(SMOOTHEST);
        base_and_lobe(at, self.diffuse, self.f0, alpha, |half| ggx_distribution(half, alpha))
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        vectors::evaluate(self, at, out);
    }
}

/// The same formula for whole vectors.
impl Formula for Ggx {
    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 3] {
        let constant = |v: f32| simd.splat_f32s(v);
        let [lobe, fifth] = lobe_and_fifth(simd, self.alpha, light, view);
        [0, 1, 2].map(|channel| {
            let f0 = self.f0[channel];
            let fresnel = simd.mul_add_e_f32s(constant(1.0 - f0), fifth, constant(f0));
            let base = constant(self.diffuse[channel] * FRAC_1_PI);
            simd.min_f32s(simd.mul_add_e_f32s(lobe, fresnel, base), constant(f32::MAX))
        })
    }
}

/// D G / (4 cos θ_i cos θ_o), and (1 − cos θ_diff)⁵.
#[inline(always)]
pub(super) fn lobe_and_fifth<S: Simd>(simd: S, alpha: f32, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 2] {
    let constant = |v: f32| simd.splat_f32s(v);
    let alpha = alpha.max(SMOOTHEST);
    let a2 = alpha * alpha;
    let [sx, sy, sz] = [0, 1, 2].map(|axis| simd.add_f32s(light[axis], view[axis]));
    let across = simd.mul_add_e_f32s(sx, sx, simd.mul_f32s(sy, sy));
    let up = simd.mul_f32s(sz, sz);
    let length2 = simd.add_f32s(across, up);
    // |s|² times what D calls spread
    let spread = simd.mul_add_e_f32s(constant(a2), up, across);
    let relative = simd.div_f32s(length2, spread);
    let density = simd.mul_f32s(constant(a2 * FRAC_1_PI), simd.mul_f32s(relative, relative));
    let lobe = simd.mul_f32s(density, visibility(simd, a2, light[2], view[2]));
    let dot = simd.mul_add_e_f32s(light[2], sz, simd.mul_add_e_f32s(light[0], sx, simd.mul_f32s(light[1], sy)));
    let cos_diff = simd.div_f32s(dot, simd.sqrt_f32s(length2));
    [lobe, schlick_fifth(simd, cos_diff)]
}

/// G / (4 cos θ_i cos θ_o) for α²; see [`ggx_visibility`](super::microfacet::ggx_visibility).
#[inline(always)]
pub(super) fn visibility<S: Simd>(simd: S, a2: f32, cos_i: S::f32s, cos_o: S::f32s) -> S::f32s {
    let constant = |v: f32| simd.splat_f32s(v);
    let side = simd.sqrt_f32s(simd.mul_add_e_f32s(constant(1.0 - a2), simd.mul_f32s(cos_i, cos_i), constant(a2)));
    let other = simd.sqrt_f32s(simd.mul_add_e_f32s(constant(1.0 - a2), simd.mul_f32s(cos_o, cos_o), constant(a2)));
    let sides = simd.mul_add_e_f32s(cos_o, side, simd.mul_f32s(cos_i, other));
    simd.div_f32s(constant(0.5), sides)
}

/// (1 − cos θ_diff)⁵.
#[inline(always)]
pub(super) fn schlick_fifth<S: Simd>(simd: S, cos_diff: S::f32s) -> S::f32s {
    let [zero, one] = [0.0, 1.0].map(|v| simd.splat_f32s(v));
    let grazing = simd.max_f32s(simd.min_f32s(simd.sub_f32s(one, cos_diff), one), zero);
    let square = simd.mul_f32s(grazing, grazing);
    simd.mul_f32s(simd.mul_f32s(square, square), grazing)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::metric::directional_albedo;

    fn mirror_like(alpha: f32) -> Ggx {
        Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(1.0), alpha }
    }

    #[test]
    fn the_peak_facing_the_normal_is_f0_over_four_pi_alpha_squared() {
        let at = Directions::from_angles(0.0, 0.0, 0.0, 0.0);
        let expected = 0.5 / (4.0 * std::f32::consts::PI * 0.04);
        let ggx = Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(0.5), alpha: 0.2 };
        assert!((ggx.eval(at)[1] / expected - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_white_lobe_never_reflects_more_than_it_receives() {
        for alpha in [0.1, 0.3, 0.6, 1.0] {
            for degrees in [0.0_f32, 45.0, 80.0] {
                let albedo = directional_albedo(&mirror_like(alpha), degrees.to_radians())[0];
                assert!(albedo < 1.0 + 5e-3 && albedo > 0.3, "alpha {alpha}, {degrees} degrees: {albedo}");
            }
        }
    }

    /// α = 1 facing the normal is ∫ c / (1 + c) dc over 0..1.
    #[test]
    fn the_roughest_white_lobe_seen_from_above_keeps_one_minus_ln_two() {
        let albedo = directional_albedo(&mirror_like(1.0), 0.0)[0];
        assert!((albedo - (1.0 - std::f32::consts::LN_2)).abs() < 5e-5, "{albedo}");
    }

    #[test]
    fn many_pairs_are_what_each_of_them_is() {
        let at: Vec<Directions> = crate::sampling::rus32k().iter().step_by(19).copied().collect();
        let below = Directions::from_angles(1.8, 0.0, 0.2, 1.0);
        let at: Vec<Directions> = at.into_iter().chain([below]).collect();
        for alpha in [0.0, 0.01, 0.3, 1.0] {
            let ggx = Ggx { diffuse: Rgb([0.2, 0.1, 0.0]), f0: Rgb([0.04, 0.5, 1.0]), alpha };
            let mut together = vec![Rgb::BLACK; at.len()];
            ggx.eval_into(&at, &mut together);
            for (at, together) in at.iter().zip(together) {
                let alone = ggx.eval(*at);
                assert!(alone.zip(together, |a, b| (a - b).abs() / (1.0 + a)).max() < 2e-5, "{alone:?} {together:?}");
            }
        }
    }

    proptest! {
        #[test]
        fn light_and_view_may_be_exchanged(
            theta_i in 0.0..1.5_f32, theta_o in 0.0..1.5_f32, phi in -3.0..3.0_f32, alpha in 0.01..1.0_f32,
        ) {
            let ggx = Ggx { diffuse: Rgb([0.2, 0.1, 0.0]), f0: Rgb([0.04, 0.5, 1.0]), alpha };
            let at = Directions::from_angles(theta_i, 0.0, theta_o, phi);
            let (there, back) = (ggx.eval(at), ggx.eval(at.swapped()));
            for channel in 0..3 {
                prop_assert!((there[channel] - back[channel]).abs() <= 1e-4 * there[channel]);
            }
        }

        #[test]
        fn values_are_finite_and_not_negative_for_any_directions(
            theta_i in 0.0..3.2_f32, theta_o in 0.0..3.2_f32, phi in -3.2..3.2_f32, alpha in 0.0..1.0_f32,
        ) {
            let value = mirror_like(alpha).eval(Directions::from_angles(theta_i, 0.0, theta_o, phi));
            prop_assert!(value.is_finite() && value.min() >= 0.0);
        }
    }
}
