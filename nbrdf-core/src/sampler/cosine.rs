//! Lights in proportion to cos θ_i: perfect for Lambert, and what every other sampler must beat.
//!
//! A uniform point of the unit disk, lifted to the hemisphere (N. Malley; M. Pharr, W. Jakob, G. Humphreys, *Physically
//! Based Rendering*, 4th ed. 2023, section A.5.3).

use std::f32::consts::{FRAC_1_PI, TAU};

use super::{Sample, Sampler};
use crate::{Directions, Vec3};

/// Smallest cosine drawn, so that no sample lies on the horizon.
pub(super) const LOWEST: f32 = 1e-6;

/// p = cos θ_i / π.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cosine;

impl Sampler for Cosine {
    fn sample(&self, _: Vec3, [u, v]: [f32; 2]) -> Sample {
        let (sin, cos) = (TAU * v).sin_cos();
        let radius = u.sqrt();
        let z = (1.0 - u).sqrt().max(LOWEST);
        Sample { light: Vec3::new(radius * cos, radius * sin, z), pdf: z * FRAC_1_PI }
    }

    fn pdf(&self, at: Directions) -> f32 {
        if at.is_above() { at.light.z * FRAC_1_PI } else { 0.0 }
    }
}
