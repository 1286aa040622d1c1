//! Importance sampling beside evaluation: drawing light directions where a material reflects.

pub mod blinn_phong;
pub mod cosine;
pub mod curvature;
mod disk;
mod fit;
pub mod lobe;
mod mixture;
mod outgoing;
pub mod uniform;
pub mod variance;
pub(crate) mod visible_normals;

use crate::{Directions, Vec3};

/// Draws light directions for a viewer, densely where it expects f cos θ_i to be large.
///
/// Contract: for every viewer above the surface, [`pdf`](Self::pdf) is the density of [`sample`](Self::sample) over
/// the hemisphere and integrates to 1; lights below the horizon are neither drawn nor have a density.
pub trait Sampler: Send + Sync {
    /// ω_i for the viewer `view` (a unit vector above the surface) from `u`, uniform in \[0, 1)².
    fn sample(&self, view: Vec3, u: [f32; 2]) -> Sample;

    /// Density \[1/sr\] with which [`sample`](Self::sample) draws `at.light` for the viewer `at.view`; 0 below the horizon.
    fn pdf(&self, at: Directions) -> f32;
}

/// A drawn light direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// ω_i, a unit vector above the surface.
    pub light: Vec3,
    /// Its density \[1/sr\], above 0.
    pub pdf: f32,
}
