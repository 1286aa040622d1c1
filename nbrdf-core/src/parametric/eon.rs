//! Rough diffuse reflection that keeps its energy: Fujii's form of Oren–Nayar and a multiple-scattering lobe.
//!
//! J. Portsmouth, P. Kutz, S. Hill, *EON: A Practical Energy-Preserving Rough Diffuse BRDF* (2025), sections 2 and 3. Reciprocal; of
//! roughness 0 it is Lambert's.

use std::f32::consts::{FRAC_1_PI, PI};

use crate::{Directions, Rgb};

/// A roughness, 0..1, and a colour, 0..1.
#[derive(Clone, Copy)]
pub(super) struct Eon {
    color: Rgb,
    roughness: f32,
    /// Reflectance of the single-scattering lobe facing the normal.
    facing: f32,
    /// Colour of the multiple-scattering lobe over what it is normalised with.
    many: Rgb,
}

impl Eon {
    pub fn new(color: Rgb, roughness: f32) -> Self {
        let facing = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * PI)) * roughness);
        let mean = facing * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * PI)) * roughness);
        let left = (1.0 - mean).max(1e-7);
        let many = color.map(|rho| rho * rho * mean / (1.0 - rho * left) / left);
        Self { color, roughness, facing, many }
    }

    /// f_r of a pair above the surface.
    pub fn eval(&self, at: Directions) -> Rgb {
        let (light, view) = (at.light.z.clamp(1e-6, 1.0), at.view.z.clamp(1e-6, 1.0));
        let along = at.light.dot(at.view) - light * view;
        let slant = if along > 0.0 { along / light.max(view) } else { along };
        let once = self.facing * (1.0 + self.roughness * slant);
        let lost = (1.0 - self.albedo(light)).max(0.0) * (1.0 - self.albedo(view)).max(0.0);
        self.color.zip(self.many, |color, many| FRAC_1_PI * (color * once + many * lost))
    }

    /// What the white single-scattering lobe reflects.
    fn albedo(&self, cosine: f32) -> f32 {
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let shape =
            sine * (cosine.acos() - sine * cosine) + 2.0 / 3.0 * ((sine / cosine) * (1.0 - sine.powi(3)) - sine);
        self.facing * (1.0 + self.roughness * FRAC_1_PI * shape)
    }
}
