//! Lights everywhere alike: what sampling costs when nothing is known.

use std::f32::consts::TAU;

use super::{Sample, Sampler};
use crate::{Directions, Vec3};

/// p = 1 / 2π.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Uniform;

impl Sampler for Uniform {
    fn sample(&self, _: Vec3, [u, v]: [f32; 2]) -> Sample {
        // In (0, 1]: no sample lies on the horizon.
        let z = 1.0 - u;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (TAU * v).sin_cos();
        Sample { light: Vec3::new(radius * cos, radius * sin, z), pdf: 1.0 / TAU }
    }

    fn pdf(&self, at: Directions) -> f32 {
        if at.is_above() { 1.0 / TAU } else { 0.0 }
    }
}
