//! Mirror reflections off the normals of a GGX surface that the viewer sees, folded at the horizon.
//!
//! p(ω_i) = V(ω_i) + V(ω_i*), V = G₁(ω_o) D(h) / (4 cos θ_o), with ω_i* the light mirrored at the surface. E. Heitz,
//! *Sampling the GGX Distribution of Visible Normals* (2018, JCGT 7(4)); drawn as J. Dupuy and A. Benyoub do,
//! *Sampling Visible GGX Normals with Spherical Caps* (2023, doi 10.1111/cgf.14867). Differs from both: reflections that
//! end below the horizon are not lost but mirrored back above it, so the density integrates to 1 for every view.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::mixture::Glossy;

/// Of a surface of roughness α.
#[derive(Clone, Copy)]
pub(crate) struct VisibleNormals {
    /// α of GGX, 0 < α ≤ 1.
    pub(crate) alpha: f64,
}

impl VisibleNormals {
    /// A unit normal that the viewer sees, from `u` and `v` uniform in \[0, 1); v turns it about the view.
    pub(crate) fn normal(self, view: DVec3, [u, v]: [f64; 2]) -> DVec3 {
        let stretch = DVec3::new(self.alpha, self.alpha, 1.0);
        // On the stretched surface α is 1, and the visible normals are halfway between the view and a uniform point
        // of a spherical cap.
        let seen = (view * stretch).normalize();
        let z = (1.0 - u) * (1.0 + seen.z) - seen.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (sin, cos) = (TAU * v).sin_cos();
        ((DVec3::new(radius * cos, radius * sin, z) + seen) * stretch).normalize()
    }
}

impl Glossy for VisibleNormals {
    fn draw(&self, view: DVec3, u: [f64; 2]) -> DVec3 {
        let half = self.normal(view, u);
        let light = half * (2.0 * view.dot(half)) - view;
        light.with_z(light.z.abs())
    }

    fn density(&self, light: DVec3, view: DVec3) -> f64 {
        let square = self.alpha * self.alpha;
        // G₁ / (4 cos θ_o), written so that it stays finite at grazing views.
        let masking = 0.5 / (view.z + (square + (1.0 - square) * view.z * view.z).sqrt());
        let below = light.with_z(-light.z);
        masking * (distribution(light + view, square) + distribution(below + view, square))
    }
}

/// D(h) for h along `sum`, not normalised; 0 where the normal faces downwards, which no viewer sees.
fn distribution(sum: DVec3, square: f64) -> f64 {
    if sum.z <= 0.0 {
        return 0.0;
    }
    let (flat, upright) = (sum.x * sum.x + sum.y * sum.y, sum.z * sum.z);
    let ratio = (flat + upright) / (square * upright + flat);
    square * ratio * ratio / PI
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facing_the_normal_the_density_of_the_mirror_direction_is_that_of_ggx() {
        // D / (4 cos θ_o) = 1 / (4 π α²), and nothing is masked.
        let peak = VisibleNormals { alpha: 0.1 }.density(DVec3::Z, DVec3::Z);
        assert!((peak - 1.0 / (0.04 * PI)).abs() < 1e-9);
    }

    #[test]
    fn the_first_sample_is_the_mirror_direction_stretched_towards_the_view() {
        let view = DVec3::new(0.6, 0.0, 0.8);
        let light = VisibleNormals { alpha: 1.0 }.draw(view, [0.0, 0.0]);
        assert!(light.z > 0.0 && (light.length() - 1.0).abs() < 1e-12);
    }
}
