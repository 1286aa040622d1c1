//! What people call a material by: how light, what hue, how glossy, rough, metallic, sheeny; measured on its reflectance.
//!
//! From two directional albedos and one profile of the highlight. The split of the highlight into strength and width
//! follows the two perceptual dimensions of gloss (F. Pellacini, J. Ferwerda, D. Greenberg, *Toward a
//! Psychophysically-Based Light Reflection Model for Image Synthesis* (2000)): contrast, a cube root of energy, and width.

use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

use serde::Serialize;

use crate::brdf::Prepared;
use crate::color::luminance;
use crate::metric::chromaticity_and_slopes;
use crate::sampling::rings_and_spokes;
use crate::{Brdf, Directions, Rgb, Rusinkiewicz};

/// Viewing angles of the albedos \[degrees\]: from the front, and grazing.
const FRONT: f32 = 20.0;
const GRAZING: f32 = 75.0;
/// Half angles of the profile, crowded towards the normal.
const PROFILE: usize = 40;
/// Largest half angle of the profile, and from where it counts as the body's \[rad\].
const WIDEST: f32 = 1.15;
const BODY_FROM: f32 = 0.95;
/// θ_diff of the profile \[rad\].
const DIFF: f32 = 0.35;

/// The measured qualities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Qualities {
    /// L* / 100 of the albedo seen from the front, 0..1.
    pub lightness: f64,
    /// u′v′ of the same albedo, from white.
    pub colour: [f64; 2],
    /// Cube root of the share of light in the highlight: 0 for none, 1 for all of it, more where light is made.
    pub gloss: f64,
    /// Square root of the highlight's RMS half angle \[√rad\]: 0 for a mirror, 1.07 at most.
    pub roughness: f64,
    /// Share of the highlight in all that is reflected, 0..1.
    pub metalness: f64,
    /// ln of grazing over front albedo; 0 for Lambert.
    pub sheen: f64,
    /// L* / 100 of what is reflected away from the highlight, 0..1.
    pub body: f64,
}

/// Where everything is measured.
struct Places {
    at: Prepared,
    /// Quadrature weights of the front and the grazing albedo.
    albedos: [Vec<f64>; 2],
    /// Half angle, and sin θ cos θ Δθ, along the profile.
    profile: Vec<(f64, f64)>,
}

impl Places {
    fn get() -> &'static Self {
        static PLACES: OnceLock<Places> = OnceLock::new();
        PLACES.get_or_init(|| {
            let [front, grazing] = [FRONT, GRAZING].map(|degrees| rings_and_spokes(degrees.to_radians(), 32, 16));
            let angle = |k: usize| WIDEST * ((k as f32 + 0.5) / PROFILE as f32).powi(2);
            let edge = |k: usize| WIDEST * (k as f32 / PROFILE as f32).powi(2);
            let across = |k: usize| -> Directions {
                let half = Rusinkiewicz { theta_half: angle(k), theta_diff: DIFF, phi_diff: FRAC_PI_2, phi_half: 0.0 };
                half.directions()
            };
            let measure = |k: usize| {
                let theta = f64::from(angle(k));
                (theta, theta.sin() * theta.cos() * f64::from(edge(k + 1) - edge(k)))
            };
            let at = front.at.into_iter().chain(grazing.at).chain((0..PROFILE).map(across));
            Self {
                at: Prepared::new(at.collect()),
                albedos: [front.weights, grazing.weights],
                profile: (0..PROFILE).map(measure).collect(),
            }
        })
    }
}

impl Qualities {
    /// Of a material.
    pub fn of(brdf: &dyn Brdf) -> Self {
        let places = Places::get();
        let mut values = vec![Rgb::BLACK; places.at.len()];
        brdf.eval_prepared(&places.at, &mut values);
        let mut values = values.into_iter();
        let [front, grazing] = places.albedos.each_ref().map(|weights| {
            let sum = |sum: [f64; 3], (f, weight): (Rgb, &f64)| [0, 1, 2].map(|c| sum[c] + f64::from(f[c]) * weight);
            values.by_ref().take(weights.len()).zip(weights).fold([0.0; 3], sum)
        });
        let profile: Vec<f64> = values.map(|f| f.luminance()).collect();
        let body = body(places, &profile);
        let (mut energy, mut second) = (0.0, 0.0);
        for ((theta, weight), f) in places.profile.iter().zip(&profile) {
            let above = excess(f - body);
            energy += above * weight;
            second += above * weight * theta * theta;
        }
        // dω_i = 4 cos θ_diff dω_half
        let highlight = 2.0 * f64::from(PI) * 4.0 * f64::from(DIFF.cos()) * energy;
        let diffuse = f64::from(PI) * body.max(0.0);
        let [colour, white] = [front, [1.0; 3]].map(|linear| chromaticity_and_slopes(linear).0);
        let front = luminance(front);
        Self {
            lightness: lightness(front),
            colour: [colour[0] - white[0], colour[1] - white[1]],
            gloss: highlight.cbrt(),
            roughness: (second / energy.max(1e-12)).sqrt().sqrt(),
            metalness: highlight / (highlight + diffuse).max(1e-9),
            sheen: ((luminance(grazing) + 1e-3) / (front + 1e-3)).ln(),
            body: lightness(diffuse),
        }
    }
}

/// Mean of the profile far from the highlight.
fn body(places: &Places, profile: &[f64]) -> f64 {
    let far = || places.profile.iter().zip(profile).filter(|((theta, _), _)| *theta > f64::from(BODY_FROM));
    far().map(|(_, f)| f).sum::<f64>() / far().count().max(1) as f64
}

/// x above 0 and nearly nothing below, without a kink; never negative.
fn excess(x: f64) -> f64 {
    const SOFT: f64 = 1e-4;
    0.5 * (x + x.hypot(SOFT))
}

/// L* / 100 (CIE 1976).
fn lightness(y: f64) -> f64 {
    let cut = (6.0f64 / 29.0).powi(3);
    if y > cut { 1.16 * y.cbrt() - 0.16 } else { y * 9.033 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::brdf::lambert::Lambert;

    fn plastic(alpha: f32) -> Ggx {
        Ggx { diffuse: Rgb([0.4, 0.1, 0.1]), f0: Rgb::splat(0.05), alpha }
    }

    #[test]
    fn a_matte_material_has_no_highlight() {
        let found = Qualities::of(&Lambert { albedo: Rgb::splat(0.184) });
        assert!((found.lightness - 0.5).abs() < 0.01 && (found.body - 0.5).abs() < 0.01, "{found:?}");
        assert!(found.gloss < 0.1 && found.metalness < 0.01 && found.sheen.abs() < 0.01, "{found:?}");
        assert!(found.colour[0].hypot(found.colour[1]) < 1e-3);
    }

    #[test]
    fn rougher_is_wider_and_keeps_the_rest() {
        let [sharp, wide] = [0.1, 0.3].map(|alpha| Qualities::of(&plastic(alpha)));
        assert!(wide.roughness > sharp.roughness + 0.1, "{sharp:?} {wide:?}");
        assert!((wide.gloss - sharp.gloss).abs() < 0.05 && (wide.lightness - sharp.lightness).abs() < 0.02);
    }

    #[test]
    fn metal_is_all_highlight_and_plastic_is_not() {
        let gold = Qualities::of(&Ggx { diffuse: Rgb::BLACK, f0: Rgb([1.0, 0.77, 0.34]), alpha: 0.2 });
        assert!(gold.metalness > 0.9 && gold.gloss > 0.8, "{gold:?}");
        assert!(Qualities::of(&plastic(0.2)).metalness < 0.4);
    }

    #[test]
    fn a_stronger_highlight_is_glossier() {
        let of = |f0: f32| Qualities::of(&Ggx { f0: Rgb::splat(f0), ..plastic(0.2) }).gloss;
        assert!(of(0.1) > of(0.05) && of(0.05) > of(0.02));
    }
}
