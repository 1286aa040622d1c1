//! The three factors of a microfacet lobe, D G F / (4 cos θ_i cos θ_o), each as a function.
//!
//! [`Distribution`] names the ways facets are turned: GTR of any tail (B. Burley, *Physically-Based Shading at Disney*
//! (2012), appendix B.2; γ = 2 is GGX), Beckmann (Walter et al. 2007, eq. 25), Blinn–Phong (the same, eq. 30).
//!
//! B. Walter, S. Marschner, H. Li, K. Torrance, *Microfacet Models for Refraction through Rough Surfaces* (2007);
//! E. Heitz, *Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs* (2014), section 6.
//! Cosines are 0..1, α is the roughness parameter, above 0 and at most 1.

use std::f32::consts::{FRAC_1_PI, PI};

use glam::Vec3;

use crate::{Directions, Rgb};

/// D of GGX \[1/sr\] at the unit half vector `half` (Walter et al. 2007, eq. 33).
///
/// tan² comes from x² + y² rather than 1 − z²: near the normal that difference has no digits left.
pub(crate) fn ggx_distribution(half: Vec3, alpha: f32) -> f32 {
    if half.z <= 0.0 {
        return 0.0;
    }
    let a2 = alpha * alpha;
    let spread = half.x * half.x + half.y * half.y + a2 * half.z * half.z;
    a2 / (PI * spread * spread)
}

/// How microfacets are turned, for a roughness α.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Generalized Trowbridge–Reitz: γ = 2 is GGX, smaller γ has longer tails; 1 is Berry's.
    Gtr {
        /// Exponent, at least 1.
        gamma: f32,
    },
    /// Gaussian slopes: no tails at all.
    Beckmann,
    /// A power of the cosine, exponent 2/α² − 2.
    BlinnPhong,
}

impl Distribution {
    /// D \[1/sr\] at the unit half vector `half`; 0 < α < 1.
    pub fn density(self, half: Vec3, alpha: f32) -> f32 {
        if half.z <= 0.0 {
            return 0.0;
        }
        let a2 = alpha * alpha;
        let across = half.x * half.x + half.y * half.y;
        let up = half.z * half.z;
        // 1 + (α² − 1) cos² θ without the difference that has no digits left near the normal.
        let spread = across + a2 * up;
        match self {
            Self::Gtr { gamma } if (gamma - 1.0).abs() < 1e-3 => (a2 - 1.0) / (PI * a2.ln() * spread),
            Self::Gtr { gamma } => {
                let scale = (gamma - 1.0) * (a2 - 1.0) / (PI * (1.0 - a2.powf(1.0 - gamma)));
                scale * spread.powf(-gamma)
            }
            Self::Beckmann => (-across / (up * a2)).exp() / (PI * a2 * up * up),
            Self::BlinnPhong => {
                let exponent = 2.0 / a2 - 2.0;
                (exponent + 2.0) / (2.0 * PI) * half.z.powf(exponent)
            }
        }
    }
}

/// G / (4 cos θ_i cos θ_o) with the height-correlated Smith G of GGX (Heitz 2014, eq. 99).
///
/// Grows without bound where both cosines go to 0.
pub(crate) fn ggx_visibility(cos_i: f32, cos_o: f32, alpha: f32) -> f32 {
    let a2 = alpha * alpha;
    let one_side = |this: f32, that: f32| that * (a2 + (1.0 - a2) * this * this).sqrt();
    0.5 / (one_side(cos_i, cos_o) + one_side(cos_o, cos_i))
}

/// Fresnel reflectance from the one at normal incidence
/// (C. Schlick, *An Inexpensive BRDF Model for Physically-based Rendering*, 1994, eq. 15).
pub fn schlick(f0: Rgb, cos_diff: f32) -> Rgb {
    let grazing = (1.0 - cos_diff).clamp(0.0, 1.0).powi(5);
    f0.map(|f0| f0 + (1.0 - f0) * grazing)
}

/// k_d/π + D G F / (4 cos θ_i cos θ_o) of a pair above the surface, D from the unit half vector; never infinite.
pub(super) fn base_and_lobe(at: Directions, diffuse: Rgb, f0: Rgb, alpha: f32, density: impl Fn(Vec3) -> f32) -> Rgb {
    let half = (at.light + at.view).normalize();
    let lobe = density(half) * ggx_visibility(at.light.z, at.view.z, alpha);
    let fresnel = schlick(f0, at.light.dot(half));
    diffuse.zip(fresnel, |base, f| (base * FRAC_1_PI + lobe * f).min(f32::MAX))
}

/// Reflectance at normal incidence of a dielectric with index of refraction `ior` in air.
pub fn f0_from_ior(ior: f32) -> f32 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ D cos θ dω by the midpoint rule in tan θ = α tan of an even parameter, where the integrand is smooth.
    fn projected_area(density: impl Fn(Vec3) -> f32, alpha: f32) -> f64 {
        let n = 20_000;
        let step = std::f64::consts::FRAC_PI_2 / f64::from(n);
        let ring = |k: i32| {
            let s = (f64::from(k) + 0.5) * step;
            let theta = (f64::from(alpha) * s.tan()).atan();
            let jacobian = f64::from(alpha) * theta.cos().powi(2) / s.cos().powi(2);
            let half = glam::DVec3::new(theta.sin(), 0.0, theta.cos()).as_vec3();
            f64::from(density(half)) * theta.cos() * theta.sin() * jacobian
        };
        2.0 * std::f64::consts::PI * step * (0..n).map(ring).sum::<f64>()
    }

    #[test]
    fn facets_cover_the_surface_exactly_once() {
        for alpha in [0.01, 0.1, 0.3, 0.6, 1.0] {
            let area = projected_area(|half| ggx_distribution(half, alpha), alpha);
            assert!((area - 1.0).abs() < 1e-4, "alpha {alpha}: {area}");
        }
        let gtr = [1.0, 1.5, 2.0, 3.0].map(|gamma| Distribution::Gtr { gamma });
        for distribution in gtr.into_iter().chain([Distribution::Beckmann, Distribution::BlinnPhong]) {
            for alpha in [0.05, 0.1, 0.3, 0.6] {
                let area = projected_area(|half| distribution.density(half, alpha), alpha);
                assert!((area - 1.0).abs() < 1e-3, "{distribution:?} of alpha {alpha}: {area}");
            }
        }
    }

    #[test]
    fn a_smooth_surface_hides_nothing() {
        for (cos_i, cos_o) in [(0.2, 0.9), (1.0, 1.0), (0.5, 0.01)] {
            let g = 4.0 * cos_i * cos_o * ggx_visibility(cos_i, cos_o, 1e-4);
            assert!((g - 1.0).abs() < 1e-3, "{g}");
        }
    }

    #[test]
    fn glass_reflects_four_percent_and_everything_at_grazing_angles() {
        let f0 = f0_from_ior(1.5);
        assert!((f0 - 0.04).abs() < 1e-7);
        assert_eq!(schlick(Rgb::splat(f0), 1.0), Rgb::splat(f0));
        assert_eq!(schlick(Rgb::splat(f0), 0.0), Rgb::splat(1.0));
    }
}
