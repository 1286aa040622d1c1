//! Where reflectances are compared and integrated: fixed, deterministic sets of directions.

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    sync::OnceLock,
};

use glam::DVec3;
use rayon::prelude::*;

use crate::direction::turned;
use crate::{Brdf, Directions, Rgb, Rusinkiewicz};

/// Candidates of [`rus32k`], before those below a horizon are dropped.
pub const RUS32K_CANDIDATES: u32 = 32_768;

/// The root of g⁴ = g + 1: its powers give the three-dimensional sequence of lowest discrepancy of its kind
/// (M. Roberts, *The Unreasonable Effectiveness of Quasirandom Sequences*, 2018).
const G: f64 = 1.220_744_084_605_759_6;
/// Rings, and directions per ring, of [`around_mirror`]; more than half are above the surface.
const RINGS: u32 = 64;
const SPOKES: u32 = 128;
/// Pairs handed to a model at once: enough for vector kernels, small enough for the cache.
const BATCH: usize = 4096;

/// The direction set of the metrics: a low-discrepancy sequence over (θ_half, θ_diff, φ_diff) at φ_half = 0.
///
/// u = frac(½ + (k+1)(1/g, 1/g², 1/g³)) for k = 0..32767; θ_half = u₁π/2, θ_diff = u₂π/2, φ_diff = 2πu₃; only pairs
/// with both directions above the surface are kept, in the order of k. Computed in f64, then rounded.
pub fn rus32k() -> &'static [Directions] {
    static SET: OnceLock<Vec<Directions>> = OnceLock::new();
    SET.get_or_init(|| (0..RUS32K_CANDIDATES).filter_map(rus32k_candidate).collect())
}

/// [`rus32k`], every pair turned about the normal by the next multiple of the golden angle: for materials that change when
/// they are turned.
pub fn turned_rus32k() -> Vec<Directions> {
    let golden = TAU * (1.0 - 2.0 / (1.0 + 5.0f64.sqrt()));
    let angle = |k: usize| ((k as f64 * golden) % TAU) as f32;
    rus32k().iter().enumerate().map(|(k, &at)| turned(at, angle(k))).collect()
}

fn rus32k_candidate(k: u32) -> Option<Directions> {
    let u = [G, G * G, G * G * G].map(|power| (0.5 + f64::from(k + 1) / power).fract());
    let (sin_half, cos_half) = (u[0] * FRAC_PI_2).sin_cos();
    let (sin_diff, cos_diff) = (u[1] * FRAC_PI_2).sin_cos();
    let (sin_phi, cos_phi) = (u[2] * TAU).sin_cos();
    let (x, y) = (sin_diff * cos_phi, sin_diff * sin_phi);
    let to_surface =
        |x: f64, y: f64| DVec3::new(cos_half * x + sin_half * cos_diff, y, cos_half * cos_diff - sin_half * x);
    let (light, view) = (to_surface(x, y), to_surface(-x, -y));
    (light.z > 0.0 && view.z > 0.0).then(|| Directions::new(light.as_vec3(), view.as_vec3()))
}

/// Pairs of the sequence of [`rus32k`], begun elsewhere: none of them is one of the metrics'.
pub(crate) fn even_directions() -> impl Iterator<Item = Directions> {
    even_shares().map(half_difference).filter(|at| at.is_above())
}

/// The same as shares of the ranges of θ_half, θ_diff, φ_diff, those below the horizon too.
pub(crate) fn even_shares() -> impl Iterator<Item = [f32; 3]> {
    let place = |k: u32, power: f64| (0.25 + f64::from(k) / power).fract() as f32;
    (0..).map(move |k| [G, G * G, G * G * G].map(|power| place(k, power)))
}

/// The pair at these shares of the ranges of θ_half, θ_diff, φ_diff.
pub(crate) fn half_difference([half, diff, around]: [f32; 3]) -> Directions {
    let [half, diff, around] =
        [(half, FRAC_PI_2), (diff, FRAC_PI_2), (around, TAU)].map(|(share, range)| share * range as f32);
    Rusinkiewicz { theta_half: half, theta_diff: diff, phi_diff: around, phi_half: 0.0 }.directions()
}

/// Pairs of directions that share a viewer, and what each counts in an integral over light directions.
#[derive(Clone, Debug)]
pub struct Quadrature {
    /// Light over the hemisphere, view in the x–z plane.
    pub at: Vec<Directions>,
    /// cos θ_i dω_i \[sr\] of each pair; they sum to π.
    pub weights: Vec<f64>,
}

/// 4096 to 6000 lights above the surface for a viewer at polar angle `theta_o` \[rad\], 0 ≤ θ_o < π/2.
///
/// Rings around the mirror direction, dense where highlights are: at 80° a lobe of α = 0.1 falls between the
/// points of a uniform or cosine-mapped set of this size (7 % error), and is resolved here (below 0.1 %).
pub fn around_mirror(theta_o: f32) -> Quadrature {
    rings_and_spokes(theta_o, RINGS, SPOKES)
}

/// As [`around_mirror`], of so many rings and so many directions per ring.
pub(crate) fn rings_and_spokes(theta_o: f32, rings: u32, spokes: u32) -> Quadrature {
    let (sin_o, cos_o) = f64::from(theta_o).sin_cos();
    let view = DVec3::new(sin_o, 0.0, cos_o).as_vec3();
    let (mirror, tangent) = (DVec3::new(-sin_o, 0.0, cos_o), DVec3::new(cos_o, 0.0, sin_o));
    let around: Vec<DVec3> = (0..spokes)
        .map(|k| {
            let (sin, cos) = ((f64::from(k) + 0.5) / f64::from(spokes) * TAU).sin_cos();
            tangent * cos + DVec3::Y * sin
        })
        .collect();
    let mut found = Quadrature { at: Vec::new(), weights: Vec::new() };
    for ring in 0..rings {
        // ψ = π u²: the ring's angle from the mirror direction; dω = sin ψ dψ dχ, less the constant factors.
        let u = (f64::from(ring) + 0.5) / f64::from(rings);
        let (sin, cos) = (PI * u * u).sin_cos();
        for &spoke in &around {
            let light = mirror * cos + spoke * sin;
            let at = Directions::new(light.as_vec3(), view);
            if at.is_above() {
                found.at.push(at);
                found.weights.push(u * sin * light.z);
            }
        }
    }
    let scale = PI / found.weights.iter().sum::<f64>();
    found.weights.iter_mut().for_each(|weight| *weight *= scale);
    found
}

/// f_r at every pair, in parallel batches; the result does not depend on the number of threads.
pub fn evaluate(brdf: &dyn Brdf, at: &[Directions]) -> Vec<Rgb> {
    batched(at, |at, out| brdf.eval_into(at, out))
}

/// Like [`evaluate`], before the model's own clamp at zero.
pub fn evaluate_signed(brdf: &dyn Brdf, at: &[Directions]) -> Vec<Rgb> {
    batched(at, |at, out| brdf.eval_signed_into(at, out))
}

fn batched(at: &[Directions], eval: impl Fn(&[Directions], &mut [Rgb]) + Sync) -> Vec<Rgb> {
    let mut out = vec![Rgb::BLACK; at.len()];
    at.par_chunks(BATCH).zip(out.par_chunks_mut(BATCH)).for_each(|(at, out)| eval(at, out));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_is_above_the_surface_and_of_unit_length() {
        for at in rus32k() {
            assert!(at.is_above());
            assert!((at.light.length() - 1.0).abs() < 1e-6 && (at.view.length() - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_first_direction_has_the_angles_of_the_definition() {
        let first = rus32k()[0].rusinkiewicz();
        let u = [G, G * G, G * G * G].map(|power| (0.5 + 1.0 / power).fract());
        assert!((f64::from(first.theta_half) - u[0] * FRAC_PI_2).abs() < 1e-6);
        assert!((f64::from(first.theta_diff) - u[1] * FRAC_PI_2).abs() < 1e-6);
        assert!((f64::from(first.phi_diff).rem_euclid(TAU) - u[2] * TAU).abs() < 1e-6);
    }

    #[test]
    fn lights_around_the_mirror_direction_integrate_powers_of_the_cosine() {
        for theta_o in [0.0, 0.8, 1.48] {
            let Quadrature { at, weights } = around_mirror(theta_o);
            assert!((4096..6000).contains(&at.len()), "{} directions", at.len());
            for power in 0..8 {
                let sum: f64 = at.iter().zip(&weights).map(|(at, w)| w * f64::from(at.light.z).powi(power)).sum();
                let expected = TAU / (f64::from(power) + 2.0);
                assert!((sum / expected - 1.0).abs() < 1e-3, "cos^{power} at {theta_o}: {sum}");
            }
        }
    }

    #[test]
    fn lights_around_the_mirror_direction_are_even_on_both_sides() {
        let Quadrature { at, weights } = around_mirror(1.0);
        let aside: f64 = at.iter().zip(&weights).map(|(at, w)| w * f64::from(at.light.y)).sum();
        assert!(aside.abs() < 1e-6, "{aside}");
    }
}
