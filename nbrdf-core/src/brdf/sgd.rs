//! Shifted gamma distribution: f = (ρ_d + ρ_s κ F D G(θ_i) G(θ_o) / (cos θ_i cos θ_o)) / π, every channel on its own.
//!
//! M. Bagher, C. Soler, N. Holzschuch, *Accurate Fitting of Measured Reflectances using a Shifted Gamma Micro-facet
//! Distribution* (2012, doi 10.1111/j.1467-8659.2012.03147.x):
//! D = exp(−a) / (π aᵖ cos⁴θ_half), a = α + tan²θ_half / α; F = F₀ − F₁ cos θ_diff + (1 − F₀)(1 − cos θ_diff)⁵;
//! G(θ) = 1 + λ(1 − exp(c max(0, θ − θ₀)ᵏ)) between 0 and 1. F as published may be a little below 0, and so may f
//! before it is clamped. Differs: ρ_s and κ, which occur as a product, are one number; c is held as the angle c^(−1/k), since
//! c itself reaches beyond what f32 holds.

use std::f32::consts::FRAC_1_PI;

use pulp::Simd;

use super::vectors::{self, Formula, Half, ln_one_plus};
use crate::simd::{angle, exp, exp_minus_one, ln};
use crate::{Brdf, Directions, Rgb};

/// A material: red, green, blue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sgd {
    /// The parameters of each channel.
    pub channels: [ShiftedGamma; 3],
}

/// The parameters of one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShiftedGamma {
    /// ρ_d, albedo of the base, 0..1.
    pub diffuse: f32,
    /// ρ_s κ, brightness of the lobe times the factor that normalizes D, 0 and more.
    pub specular: f32,
    /// α, width and shift of the distribution, above 0.
    pub alpha: f32,
    /// p, exponent of the distribution, 0 and more.
    pub p: f32,
    /// F₀.
    pub f0: f32,
    /// F₁; the lobe reflects F₀ − F₁ at normal incidence.
    pub f1: f32,
    /// G.
    pub shadowing: Shadowing,
}

/// The shadowing function of one channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadowing {
    /// λ, how deep shadows are, 0 and more.
    pub lambda: f32,
    /// c^(−1/k) \[rad\]: how far beyond θ₀ the exponent c (θ − θ₀)ᵏ is 1; above 0.
    pub reach: f32,
    /// k, how sudden shadows are, above 0.
    pub k: f32,
    /// θ₀ \[rad\], where shadows begin.
    pub theta0: f32,
}

impl Shadowing {
    /// From the four numbers as published.
    pub fn new(lambda: f32, c: f64, k: f32, theta0: f32) -> Self {
        Self { lambda, reach: c.powf(-1.0 / f64::from(k)) as f32, k, theta0 }
    }

    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, theta: S::f32s) -> S::f32s {
        let constant = |v: f32| simd.splat_f32s(v);
        let [zero, one] = [0.0, 1.0].map(constant);
        let beyond = simd.sub_f32s(theta, constant(self.theta0));
        let power = simd.mul_f32s(constant(self.k), ln(simd, simd.mul_f32s(beyond, constant(1.0 / self.reach))));
        let lost = simd.mul_f32s(constant(self.lambda), exp_minus_one(simd, exp(simd, power)));
        let open = simd.min_f32s(simd.max_f32s(simd.sub_f32s(one, lost), zero), one);
        simd.select_f32s(simd.greater_than_f32s(beyond, zero), open, one)
    }
}

impl Brdf for Sgd {
    fn eval(&self, at: Directions) -> Rgb {
        vectors::evaluate_one(self, at).map(|f| f.max(0.0))
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        vectors::evaluate(self, at, out);
        out.iter_mut().for_each(|f| *f = f.map(|f| f.max(0.0)));
    }

    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        vectors::evaluate(self, at, out);
    }
}

impl Formula for Sgd {
    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 3] {
        let constant = |v: f32| simd.splat_f32s(v);
        let one = constant(1.0);
        let half = Half::of(simd, light, view);
        let [theta_i, theta_o] = [light, view]
            .map(|[x, y, z]| angle(simd, simd.sqrt_f32s(simd.mul_add_e_f32s(x, x, simd.mul_f32s(y, y))), z));
        let grazing = simd.sub_f32s(one, half.cos_diff);
        let square = simd.mul_f32s(grazing, grazing);
        let fifth = simd.mul_f32s(simd.mul_f32s(square, square), grazing);
        // 1 / cos⁴ θ_half as its logarithm: it never meets a D that has run out of numbers.
        let steep = ln_one_plus(simd, half.tan2);
        let at = Place {
            half,
            fifth,
            steep: simd.add_f32s(steep, steep),
            polar: [theta_i, theta_o],
            cosines: simd.max_f32s(simd.mul_f32s(light[2], view[2]), constant(1e-18)),
        };
        let [r, g, b] = &self.channels;
        [r.vector(simd, &at), g.vector(simd, &at), b.vector(simd, &at)]
    }
}

/// What all channels read of a vector of pairs.
struct Place<S: Simd> {
    half: Half<S>,
    /// (1 − cos θ_diff)⁵.
    fifth: S::f32s,
    /// −4 ln cos θ_half.
    steep: S::f32s,
    /// θ_i and θ_o.
    polar: [S::f32s; 2],
    /// cos θ_i cos θ_o.
    cosines: S::f32s,
}

impl ShiftedGamma {
    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, at: &Place<S>) -> S::f32s {
        let constant = |v: f32| simd.splat_f32s(v);
        let a = simd.mul_add_e_f32s(at.half.tan2, constant(1.0 / self.alpha), constant(self.alpha));
        let fall = simd.mul_add_e_f32s(constant(self.p), ln(simd, a), a);
        let density = exp(simd, simd.sub_f32s(at.steep, fall));
        let straight = simd.mul_add_e_f32s(constant(-self.f1), at.half.cos_diff, constant(self.f0));
        let fresnel = simd.mul_add_e_f32s(constant(1.0 - self.f0), at.fifth, straight);
        let [light, view] = at.polar;
        let open = simd.mul_f32s(self.shadowing.vector(simd, light), self.shadowing.vector(simd, view));
        let lobe = simd.div_f32s(simd.mul_f32s(density, open), at.cosines);
        let scaled = simd.mul_f32s(lobe, constant(self.specular * FRAC_1_PI * FRAC_1_PI));
        let sum = simd.mul_add_e_f32s(scaled, fresnel, constant(self.diffuse * FRAC_1_PI));
        simd.min_f32s(simd.max_f32s(sum, constant(-f32::MAX)), constant(f32::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: ShiftedGamma = ShiftedGamma {
        diffuse: 0.3,
        specular: 2.0,
        alpha: 0.1,
        p: 0.5,
        f0: 0.1,
        f1: 0.05,
        shadowing: Shadowing { lambda: 3.0, reach: 1.4, k: 20.0, theta0: 0.2 },
    };

    #[test]
    fn facing_the_normal_only_the_shift_of_the_distribution_is_left() {
        let sgd = Sgd { channels: [RED; 3] };
        let found = sgd.eval(Directions::from_angles(0.0, 0.0, 0.0, 0.0))[0];
        let density = (-0.1_f32).exp() / 0.1_f32.sqrt() * FRAC_1_PI;
        assert!((found / ((0.3 + 2.0 * 0.05 * density) * FRAC_1_PI) - 1.0).abs() < 1e-5, "{found}");
    }

    #[test]
    fn below_zero_is_shown_before_the_clamp_alone() {
        let dark = ShiftedGamma { diffuse: 0.0, f0: 0.1, f1: 0.2, ..RED };
        let at = [Directions::from_angles(0.1, 0.0, 0.1, 3.0)];
        let sgd = Sgd { channels: [RED, dark, RED] };
        let (mut signed, mut clamped) = ([Rgb::BLACK], [Rgb::BLACK]);
        sgd.eval_signed_into(&at, &mut signed);
        sgd.eval_into(&at, &mut clamped);
        assert!(signed[0][1] < -1e-3 && clamped[0][1] == 0.0, "{signed:?} {clamped:?}");
        assert_eq!([signed[0][0], signed[0][2]], [clamped[0][0], clamped[0][2]]);
    }

    #[test]
    fn shadows_begin_at_theta_zero_and_close_completely() {
        let white = ShiftedGamma { diffuse: 0.0, ..RED };
        let sgd = Sgd { channels: [white; 3] };
        let lobe = |theta: f32| sgd.eval(Directions::from_angles(theta, 0.0, theta, std::f32::consts::PI))[0];
        assert!(lobe(1.2) > lobe(0.3), "shadows are sudden");
        assert_eq!(lobe(1.57), 0.0);
    }

    #[test]
    fn the_exponent_is_one_where_the_reach_ends() {
        let published = Shadowing::new(3.0, 1.1e-7, 47.0, 0.2);
        assert!((1.1e-7 * f64::from(published.reach).powi(47) - 1.0).abs() < 1e-4);
        assert!(Shadowing::new(1.0, 1e38, 700.0, 0.5).reach > 0.8);
    }
}
