//! A diffuse base under an ABC lobe: f = k_d/π + F D G / (π cos θ_i cos θ_o), D = A / (1 + B(1 − cos θ_half))^C.
//!
//! J. Löw, J. Kronander, A. Ynnerman, J. Unger, *BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces*
//! (2012, doi 10.1145/2077341.2077350), equation 15, the microfacet form: the ABC function of light scattered by polished
//! surfaces as the distribution, the Fresnel reflectance of a dielectric without Schlick's approximation, and the
//! shadowing of R. Cook, K. Torrance, *A Reflectance Model for Computer Graphics* (1982). D is not normalized: A, one for
//! each channel, is the brightness. Differs: 1/π, which the equation leaves to A and the published parameters do not.

use std::f32::consts::FRAC_1_PI;

use pulp::Simd;

use super::vectors::{self, Formula, Half, ln_one_plus};
use crate::simd::exp;
use crate::{Brdf, Directions, Rgb};

/// A diffuse base and an ABC lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Abc {
    /// k_d, albedo of the base, 0..1.
    pub diffuse: Rgb,
    /// A, brightness of the lobe, 0 and more.
    pub a: Rgb,
    /// B, inverse width, 0 and more.
    pub b: f32,
    /// C, how fast the lobe falls, 0 and more.
    pub c: f32,
    /// Index of refraction, 1 and more.
    pub ior: f32,
}

impl Brdf for Abc {
    fn eval(&self, at: Directions) -> Rgb {
        vectors::evaluate_one(self, at)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        vectors::evaluate(self, at, out);
    }
}

impl Formula for Abc {
    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 3] {
        let constant = |v: f32| simd.splat_f32s(v);
        let half = Half::of(simd, light, view);
        let wide = ln_one_plus(simd, simd.mul_f32s(half.versine, constant(self.b)));
        let density = exp(simd, simd.mul_f32s(wide, constant(-self.c)));
        let fresnel = dielectric(simd, self.ior, half.cos_diff);
        let shadowing = v_groove(simd, half.cos, half.cos_diff, light[2], view[2]);
        let lobe = simd.mul_f32s(simd.mul_f32s(density, fresnel), shadowing);
        [0, 1, 2].map(|channel| {
            let base = constant(self.diffuse[channel] * FRAC_1_PI);
            let sum = simd.mul_add_e_f32s(lobe, constant(self.a[channel] * FRAC_1_PI), base);
            simd.min_f32s(sum, constant(f32::MAX))
        })
    }
}

/// G / (cos θ_i cos θ_o) of Cook and Torrance: min(1, 2 h_z i_z / cos θ_diff, 2 h_z o_z / cos θ_diff), divided.
#[inline(always)]
fn v_groove<S: Simd>(simd: S, cos_half: S::f32s, cos_diff: S::f32s, cos_i: S::f32s, cos_o: S::f32s) -> S::f32s {
    let constant = |v: f32| simd.splat_f32s(v);
    let nearer = simd.min_f32s(cos_i, cos_o);
    let groove = simd.mul_f32s(simd.add_f32s(cos_half, cos_half), nearer);
    let groove = simd.div_f32s(groove, simd.max_f32s(cos_diff, constant(1e-9)));
    let cosines = simd.max_f32s(simd.mul_f32s(cos_i, cos_o), constant(1e-18));
    simd.div_f32s(simd.min_f32s(groove, constant(1.0)), cosines)
}

/// Fresnel reflectance of unpolarized light (Cook and Torrance 1982, section 3).
#[inline(always)]
fn dielectric<S: Simd>(simd: S, ior: f32, cos_diff: S::f32s) -> S::f32s {
    let constant = |v: f32| simd.splat_f32s(v);
    let one = constant(1.0);
    // Its square stays far from overflow; published indices end at 100.
    let ior = ior.clamp(1.0, 1e6);
    let c = cos_diff;
    let g = simd.sqrt_f32s(simd.mul_add_e_f32s(c, c, constant(ior * ior - 1.0)));
    let sum = simd.max_f32s(simd.add_f32s(g, c), constant(1e-9));
    let difference = simd.sub_f32s(g, c);
    let across = simd.div_f32s(difference, sum);
    let above = simd.sub_f32s(simd.mul_f32s(c, sum), one);
    let along = simd.div_f32s(above, simd.mul_add_e_f32s(c, difference, one));
    let square = simd.mul_f32s(across, across);
    simd.mul_f32s(simd.mul_f32s(constant(0.5), square), simd.mul_add_e_f32s(along, along, one))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::microfacet::f0_from_ior;

    const GLASS: Abc = Abc { diffuse: Rgb::BLACK, a: Rgb([1.0, 2.0, 4.0]), b: 1e4, c: 1.2, ior: 1.5 };

    #[test]
    fn facing_the_normal_the_lobe_is_a_times_the_fresnel_reflectance() {
        let peak = GLASS.eval(Directions::from_angles(0.0, 0.0, 0.0, 0.0));
        for (found, a) in peak.0.into_iter().zip([1.0, 2.0, 4.0]) {
            assert!((found / (a * f0_from_ior(1.5) * FRAC_1_PI) - 1.0).abs() < 1e-5, "{peak:?}");
        }
    }

    #[test]
    fn everything_is_reflected_at_grazing_angles() {
        let at = |degrees: f32| {
            Directions::from_angles(degrees.to_radians(), 0.0, degrees.to_radians(), std::f32::consts::PI)
        };
        let fresnel = |degrees: f32| {
            let at = at(degrees);
            GLASS.eval(at)[0] * std::f32::consts::PI * at.light.z * at.view.z
        };
        // Brewster's angle of glass: half of what is reflected across the plane of incidence.
        assert!((fresnel(56.309_93) - 0.5 * (5.0_f32 / 13.0).powi(2)).abs() < 1e-5, "{}", fresnel(56.309_93));
        assert!(fresnel(89.9) > 0.97);
    }

    #[test]
    fn light_and_view_may_be_exchanged() {
        let at = Directions::from_angles(0.4, 0.0, 1.1, 2.5);
        let (there, back) = (GLASS.eval(at), GLASS.eval(at.swapped()));
        assert!(there.zip(back, |a, b| (a / b - 1.0).abs()).max() < 1e-5);
    }
}
