//! A glossy lobe over a cosine base, and how the share of the lobe grows towards grazing views.
//!
//! p = s(θ_o) p_glossy + (1 − s(θ_o)) cos θ_i / π, one component drawn per sample (E. Veach, *Robust Monte Carlo
//! Methods for Light Transport Simulation*, 1997, section 9.2). Computed in f64: a lobe of width 0.001 seen at 89.9° is
//! 4e-6 wide, and directions are read as what f32 rounded them to, so that `sample` and `pdf` agree.

use glam::DVec3;

use super::cosine::{Cosine, LOWEST};
use super::{Sample, Sampler};
use crate::{Directions, Vec3};

/// Largest share of a lobe, so that no light is left out: a sample counts at most 50 times a cosine's.
pub const MAX_SHARE: f32 = 0.98;

/// F(90°)/F₀ − 1 of Schlick's Fresnel factor at F₀ = 1/11. Glass has 24, metals nearly 0, but their share is high anyway.
/// Over the built-in MERL materials that are not held out, 10 lowers the mean of ln M by 0.023 of the 0.03 that a share
/// of its own for every view would; 8 to 24 are within 0.002.
const GRAZING_GAIN: f64 = 10.0;

/// A density of lights that lies around the mirror direction and integrates to 1 over the hemisphere.
pub(super) trait Glossy {
    /// A light \[unit vector\] for the viewer `view` from `u`, uniform in \[0, 1)².
    fn draw(&self, view: DVec3, u: [f64; 2]) -> DVec3;

    /// Density \[1/sr\] of [`draw`](Self::draw); both directions are unit vectors above the surface.
    fn density(&self, light: DVec3, view: DVec3) -> f64;
}

/// The share of a lobe whose share is `share` facing the normal, for a viewer of cosine `cos_o`.
///
/// The odds of the lobe grow like Schlick's Fresnel factor (1994, doi 10.1111/1467-8659.1330233).
pub(super) fn share_towards(share: f32, cos_o: f64) -> f64 {
    let share = f64::from(nearest_in([0.0, MAX_SHARE], share));
    let odds = share / (1.0 - share) * (1.0 + GRAZING_GAIN * (1.0 - cos_o.min(1.0)).powi(5));
    (odds / (1.0 + odds)).min(f64::from(MAX_SHARE))
}

/// See [`Sampler::sample`]. A viewer that is not above the surface is given a cosine sample.
pub(super) fn sample(glossy: &impl Glossy, share: f32, view: Vec3, [u, v]: [f32; 2]) -> Sample {
    let Some(toward) = above(view) else { return Cosine.sample(view, [u, v]) };
    let share = share_towards(share, toward.z);
    let u = f64::from(u);
    let light = if u < share {
        let light = glossy.draw(toward, [u / share, f64::from(v)]);
        light.with_z(light.z.max(f64::from(LOWEST))).as_vec3()
    } else {
        Cosine.sample(view, [((u - share) / (1.0 - share)) as f32, v]).light
    };
    Sample { light, pdf: pdf(glossy, share, light.as_dvec3().normalize(), toward) as f32 }
}

/// See [`Sampler::pdf`].
pub(super) fn pdf_at(glossy: &impl Glossy, share: f32, at: Directions) -> f32 {
    match (above(at.light), above(at.view)) {
        (Some(light), Some(view)) => pdf(glossy, share_towards(share, view.z), light, view) as f32,
        _ => 0.0,
    }
}

fn pdf(glossy: &impl Glossy, share: f64, light: DVec3, view: DVec3) -> f64 {
    let base = (1.0 - share) * light.z * std::f64::consts::FRAC_1_PI;
    if share > 0.0 { base + share * glossy.density(light, view) } else { base }
}

/// The nearest value in a range; its lower end for NaN.
pub(super) fn nearest_in([low, high]: [f32; 2], value: f32) -> f32 {
    if value >= low { value.min(high) } else { low }
}

/// The direction at unit length, if it is above the surface.
pub(super) fn above(direction: Vec3) -> Option<DVec3> {
    let direction = direction.as_dvec3().normalize_or_zero();
    (direction.z > 0.0).then_some(direction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_as_given_facing_the_normal_and_grows_towards_grazing_views() {
        let share = |degrees: f64| share_towards(0.2, degrees.to_radians().cos());
        assert!((share(0.0) - 0.2).abs() < 1e-7);
        assert!((share(90.0) - 0.25 * 11.0 / (1.0 + 0.25 * 11.0)).abs() < 1e-6);
        assert!((0..9).all(|k| share(f64::from(k) * 10.0) < share(f64::from(k + 1) * 10.0)));
    }

    #[test]
    fn the_cosine_base_never_vanishes_and_no_share_is_out_of_range() {
        for share in [-1.0, 0.0, 0.5, 1.0, f32::INFINITY, f32::NAN] {
            for cos_o in [0.0, 0.5, 1.0] {
                assert!((0.0..=f64::from(MAX_SHARE)).contains(&share_towards(share, cos_o)), "{share} {cos_o}");
            }
        }
        assert_eq!(share_towards(0.0, 0.0), 0.0);
    }
}
