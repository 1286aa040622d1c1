//! A diffuse base under one microfacet lobe of any [`Distribution`]: f = k_d/π + D G F / (4 cos θ_i cos θ_o).
//!
//! G is the height-correlated Smith term of GGX whatever the distribution, F is Schlick's; see
//! [`microfacet`](super::microfacet). As in [`ggx`](super::ggx), the base is not darkened where the lobe reflects.

use super::microfacet::{Distribution, base_and_lobe};
use crate::{Brdf, Directions, Rgb};

/// A diffuse base and a lobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lobed {
    /// k_d, albedo of the base, 0..1.
    pub diffuse: Rgb,
    /// F₀, reflectance of the lobe at normal incidence, 0..1.
    pub f0: Rgb,
    /// Roughness α, 0.01..0.99.
    pub alpha: f32,
    /// How the facets are turned.
    pub distribution: Distribution,
}

impl Lobed {
    /// The material `t` of the way to `other`, every parameter mixed linearly; the distribution stays.
    pub fn towards(&self, other: &Self, t: f32) -> Self {
        let mix = |a: f32, b: f32| a + t * (b - a);
        Self {
            diffuse: self.diffuse.zip(other.diffuse, mix),
            f0: self.f0.zip(other.f0, mix),
            alpha: mix(self.alpha, other.alpha),
            distribution: self.distribution,
        }
    }
}

impl Brdf for Lobed {
    fn eval(&self, at: Directions) -> Rgb {
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let alpha = self.alpha.clamp(0.01, 0.99);
        base_and_lobe(at, self.diffuse, self.f0, alpha, |half| self.distribution.density(half, alpha))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::sampling::rus32k;

    #[test]
    fn ggx_is_the_distribution_of_gamma_two() {
        let (diffuse, f0, alpha) = (Rgb([0.2, 0.1, 0.0]), Rgb([0.04, 0.5, 1.0]), 0.3);
        let ggx = Ggx { diffuse, f0, alpha };
        let other = Lobed { diffuse, f0, alpha, distribution: Distribution::Gtr { gamma: 2.0 } };
        for at in rus32k().iter().step_by(29) {
            let (a, b) = (ggx.eval(*at), other.eval(*at));
            assert!(a.zip(b, |a, b| (a - b).abs() / (1.0 + a)).max() < 2e-5, "{a:?} {b:?}");
        }
    }

    #[test]
    fn half_way_is_the_mean_of_the_parameters() {
        let distribution = Distribution::Beckmann;
        let a = Lobed { diffuse: Rgb::splat(0.2), f0: Rgb::splat(0.04), alpha: 0.1, distribution };
        let b = Lobed { diffuse: Rgb::BLACK, f0: Rgb([1.0, 0.5, 0.2]), alpha: 0.5, distribution };
        let middle = a.towards(&b, 0.5);
        assert!((middle.alpha - 0.3).abs() < 1e-6 && (middle.f0[0] - 0.52).abs() < 1e-6);
        assert_eq!(a.towards(&b, 0.0), a);
    }
}
