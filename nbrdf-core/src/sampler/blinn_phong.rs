//! A power of the half vector's cosine over a cosine base: the older lobe, to compare with.
//!
//! p = s p_h + (1 − s) cos θ_i / π, p_h = (n + 1) / (2π) (h·n)ⁿ / (4 ω_o·h) (J. F. Blinn, *Models of Light Reflection for
//! Computer Synthesized Pictures*, 1977, doi 10.1145/563858.563893), in the role that Sztrajman et al. (2021, doi
//! 10.1111/cgf.14335) give to an analytic model. Differs: half vectors whose reflections end below the horizon would be
//! lost (the density would integrate to less than 1); they are mirrored back above it, so the contract holds. The
//! density has a pole at ω_o·h = 0, which folding puts into the mirror direction: weak facing the normal, strong where
//! the view is about as near to the surface as the lobe is wide. [`Lobe`](super::lobe::Lobe) has none.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::fit::search;
use super::mixture::{self, Glossy};
use super::outgoing::Outgoing;
use super::{Sample, Sampler};
use crate::{Brdf, Directions, Vec3};

/// Largest exponent: about that of a GGX width of 0.001.
pub const MAX_EXPONENT: f32 = 2e6;

/// A Blinn–Phong lobe over a cosine base. Values out of range are taken as the nearest in range, NaN as the smallest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlinnPhong {
    /// Share of samples drawn from the lobe by a viewer facing the normal, 0..[`MAX_SHARE`](mixture::MAX_SHARE).
    pub share: f32,
    /// n, the exponent, 0..[`MAX_EXPONENT`].
    pub exponent: f32,
}

impl BlinnPhong {
    /// The lobe of least variance; as [`Lobe::fit`](super::lobe::Lobe::fit).
    pub fn fit(brdf: &dyn Brdf) -> Self {
        let seen = Outgoing::towards_viewers(brdf).unwrap_or_default();
        search(&seen, |width| PowerCosine { exponent: exponent(width) }).map_or(
            Self { share: 0.0, exponent: 0.0 },
            |(share, width)| Self { share: share as f32, exponent: exponent(width) as f32 },
        )
    }

    fn glossy(self) -> PowerCosine {
        PowerCosine { exponent: f64::from(mixture::nearest_in([0.0, MAX_EXPONENT], self.exponent)) }
    }
}

/// n of a lobe about as wide as GGX of α = `width` (B. Walter et al., *Microfacet Models for Refraction through Rough
/// Surfaces*, 2007, section 5.2).
fn exponent(width: f64) -> f64 {
    2.0 / (width * width) - 2.0
}

impl Sampler for BlinnPhong {
    fn sample(&self, view: Vec3, u: [f32; 2]) -> Sample {
        mixture::sample(&self.glossy(), self.share, view, u)
    }

    fn pdf(&self, at: Directions) -> f32 {
        mixture::pdf_at(&self.glossy(), self.share, at)
    }
}

struct PowerCosine {
    exponent: f64,
}

impl Glossy for PowerCosine {
    fn draw(&self, view: DVec3, [u, v]: [f64; 2]) -> DVec3 {
        let z = (1.0 - u).powf(1.0 / (self.exponent + 1.0));
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (TAU * v).sin_cos();
        let half = DVec3::new(radius * cos, radius * sin, z);
        let light = half * (2.0 * view.dot(half)) - view;
        light.with_z(light.z.abs())
    }

    fn density(&self, light: DVec3, view: DVec3) -> f64 {
        let below = light.with_z(-light.z);
        self.reflected(light + view) + self.reflected(below + view)
    }
}

impl PowerCosine {
    /// (n + 1) / (8π) (h·n)ⁿ / (ω_o·h) for h along `sum`, whose length is 2 ω_o·h; every light belongs to one normal.
    fn reflected(&self, sum: DVec3) -> f64 {
        // The pole at ω_o·h = 0 is integrable; beyond f32's reach it is cut off.
        let length = sum.length().max(f64::from(f32::EPSILON));
        (self.exponent + 1.0) / (4.0 * PI) * (sum.z.abs() / length).min(1.0).powf(self.exponent) / length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facing_the_normal_the_peak_is_that_of_the_formula() {
        let peak = PowerCosine { exponent: 50.0 }.density(DVec3::Z, DVec3::Z);
        // The light mirrored below is opposite to the view: its half vector lies in the surface.
        assert!((peak - 51.0 / (8.0 * PI)).abs() < 1e-9);
    }
}
