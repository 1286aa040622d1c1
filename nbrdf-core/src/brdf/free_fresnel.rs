//! A diffuse base under a microfacet lobe that may be of any brightness at grazing angles:
//! f = k_d/π + D G F / (4 cos θ_i cos θ_o), F = F₀ + (F₉₀ − F₀)(1 − cos θ_diff)⁵.
//!
//! D and G as in [`microfacet`](super::microfacet). F is Schlick's (1994, eq. 15) with the reflectance at grazing angles in
//! place of 1 (S. Lagarde, C. de Rousiers, *Moving Frostbite to Physically Based Rendering*, 2014): what is fitted to measurements needs it, since these end
//! below 90° and hold what no single lobe explains.

use std::f32::consts::{FRAC_1_PI, PI};

use pulp::Simd;

use super::ggx::{lobe_and_fifth, schlick_fifth, visibility};
use super::vectors::{self, Formula, Half, ln_one_plus};
use crate::simd::exp;
use crate::{Brdf, Directions, Rgb};

/// How the facets are turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facets {
    /// GGX.
    Ggx,
    /// Blinn–Phong of exponent 2/α² − 2, under the G of GGX, as in [`Lobed`](super::lobed::Lobed).
    BlinnPhong,
}

/// A diffuse base and a lobe of free Fresnel reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeFresnel {
    /// k_d, albedo of the base, 0 and more.
    pub diffuse: Rgb,
    /// F₀, reflectance of the lobe at normal incidence, 0 and more.
    pub f0: Rgb,
    /// F₉₀, reflectance of the lobe at grazing angles, 0 and more.
    pub f90: Rgb,
    /// Roughness α, 0.001..1 (what is out of range is taken as the nearest in range).
    pub alpha: f32,
    /// How the facets are turned.
    pub facets: Facets,
}

impl Brdf for FreeFresnel {
    fn eval(&self, at: Directions) -> Rgb {
        vectors::evaluate_one(self, at)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        vectors::evaluate(self, at, out);
    }
}

impl Formula for FreeFresnel {
    #[inline(always)]
    fn vector<S: Simd>(&self, simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 3] {
        let constant = |v: f32| simd.splat_f32s(v);
        let alpha = self.alpha.clamp(1e-3, 1.0);
        let [lobe, fifth] = match self.facets {
            Facets::Ggx => lobe_and_fifth(simd, alpha, light, view),
            Facets::BlinnPhong => power_cosine(simd, alpha * alpha, light, view),
        };
        [0, 1, 2].map(|channel| {
            let (f0, f90) = (self.f0[channel], self.f90[channel]);
            let fresnel = simd.mul_add_e_f32s(constant(f90 - f0), fifth, constant(f0));
            let base = constant(self.diffuse[channel] * FRAC_1_PI);
            simd.min_f32s(simd.mul_add_e_f32s(lobe, fresnel, base), constant(f32::MAX))
        })
    }
}

/// D G / (4 cos θ_i cos θ_o) with D = (n + 2)/(2π) cosⁿ θ_half (Walter et al. 2007, eq. 30), and (1 − cos θ_diff)⁵.
#[inline(always)]
fn power_cosine<S: Simd>(simd: S, a2: f32, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 2] {
    let constant = |v: f32| simd.splat_f32s(v);
    let half = Half::of(simd, light, view);
    // cosⁿ = (1 + tan²)^(−n/2): ln cos itself has no digits left near the normal.
    let exponent = 2.0 / a2 - 2.0;
    let power = exp(simd, simd.mul_f32s(ln_one_plus(simd, half.tan2), constant(-0.5 * exponent)));
    let density = simd.mul_f32s(power, constant((exponent + 2.0) / (2.0 * PI)));
    let lobe = simd.mul_f32s(density, visibility(simd, a2, light[2], view[2]));
    [lobe, schlick_fifth(simd, half.cos_diff)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{ggx::Ggx, lobed::Lobed, microfacet::Distribution};
    use crate::sampling::{evaluate, rus32k};

    #[test]
    fn grazing_reflectance_of_one_is_schlicks() {
        let (diffuse, f0) = (Rgb([0.2, 0.1, 0.0]), Rgb([0.04, 0.5, 1.0]));
        let f90 = Rgb::splat(1.0);
        for alpha in [0.05, 0.3, 0.9] {
            let free = |facets| FreeFresnel { diffuse, f0, f90, alpha, facets };
            let lobed = Lobed { diffuse, f0, alpha, distribution: Distribution::BlinnPhong };
            let pairs: [(Box<dyn Brdf>, Facets); 2] =
                [(Box::new(Ggx { diffuse, f0, alpha }), Facets::Ggx), (Box::new(lobed), Facets::BlinnPhong)];
            for (known, facets) in pairs {
                for (a, b) in evaluate(&*known, rus32k()).iter().zip(evaluate(&free(facets), rus32k())) {
                    let apart = a.zip(b, |a, b| (a - b).abs() / (1.0 + a)).max();
                    assert!(apart < 2e-4, "{facets:?} of alpha {alpha}: {a:?} {b:?}");
                }
            }
        }
    }
}
