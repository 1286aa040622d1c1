//! `negative_share`, `albedo_max`, `reciprocity`: whether a material could exist.

use std::f32::consts::TAU;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    Brdf, Directions, Rgb,
    direction::turned,
    sampling::{Quadrature, around_mirror, evaluate, evaluate_signed, rus32k},
};

/// Steps of θ_o in [`albedo_max`] \[degrees\].
const STEP: u16 = 5;
/// Largest θ_o in [`albedo_max`] \[degrees\].
const LAST: u16 = 85;

/// Azimuths of the viewer in [`albedo_max_around`].
const TURNS: u16 = 8;

/// The three figures of one material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Physics {
    /// See [`negative_share`].
    pub negative_share: f64,
    /// See [`albedo_max`].
    pub albedo_max: f64,
    /// See [`reciprocity`].
    pub reciprocity: f64,
}

impl Physics {
    /// Of this material.
    pub fn of(brdf: &dyn Brdf) -> Self {
        Self { negative_share: negative_share(brdf), albedo_max: albedo_max(brdf), reciprocity: reciprocity(brdf) }
    }
}

/// Share of `rus32k`, 0..1, where the model before its clamp is below 0 in any channel; NaN counts as below.
pub fn negative_share(brdf: &dyn Brdf) -> f64 {
    let values = evaluate_signed(brdf, rus32k());
    let negative = values.iter().filter(|value| !value.0.iter().all(|&v| v >= 0.0)).count();
    negative as f64 / values.len() as f64
}

/// Largest directional albedo of any channel over θ_o = 0, 5, ..., 85°; above 1, energy is made from nothing.
/// Infinite where any value is NaN: what is not a number must not pass for safe.
pub fn albedo_max(brdf: &dyn Brdf) -> f64 {
    largest((0..=LAST / STEP).map(|k| (k, 0.0)), brdf)
}

/// As [`albedo_max`], for viewers all around: of a material that changes when it is turned.
pub fn albedo_max_around(brdf: &dyn Brdf) -> f64 {
    largest(
        (0..TURNS).flat_map(|turn| (0..=LAST / STEP).map(move |k| (k, TAU * f32::from(turn) / f32::from(TURNS)))),
        brdf,
    )
}

/// Largest albedo over steps of θ_o and azimuths of the viewer \[rad\].
fn largest(places: impl Iterator<Item = (u16, f32)>, brdf: &dyn Brdf) -> f64 {
    let places: Vec<(u16, f32)> = places.collect();
    let one = |&(k, azimuth): &(u16, f32)| {
        let albedo = albedo_at(brdf, f32::from(k * STEP).to_radians(), azimuth);
        if albedo.0.iter().any(|a| a.is_nan()) { f64::INFINITY } else { f64::from(albedo.max()) }
    };
    places.par_iter().map(one).reduce(|| 0.0, f64::max)
}

/// ∫ f_r cos θ_i dω_i for a viewer at polar angle `theta_o` \[rad\], 0 ≤ θ_o < π/2: the share of light reflected.
///
/// Quadrature over at least 4096 lights [`around_mirror`]: exact for Lambert, within 0.0005 for GGX of α ≥ 0.02.
pub fn directional_albedo(brdf: &dyn Brdf, theta_o: f32) -> Rgb {
    albedo_at(brdf, theta_o, 0.0)
}

fn albedo_at(brdf: &dyn Brdf, theta_o: f32, azimuth: f32) -> Rgb {
    let Quadrature { mut at, weights } = around_mirror(theta_o);
    if azimuth != 0.0 {
        at.iter_mut().for_each(|at| *at = turned(*at, azimuth));
    }
    let mut sum = [0.0_f64; 3];
    for (value, weight) in evaluate(brdf, &at).iter().zip(weights) {
        for (sum, value) in sum.iter_mut().zip(value.0) {
            *sum += f64::from(value) * weight;
        }
    }
    Rgb(sum.map(|sum| sum as f32))
}

/// Mean |f(i, o) − f(o, i)| / mean f over `rus32k` and channels; 0 is reciprocal, and so is black.
pub fn reciprocity(brdf: &dyn Brdf) -> f64 {
    let swapped: Vec<Directions> = rus32k().iter().map(|at| at.swapped()).collect();
    let (mut difference, mut total) = (0.0, 0.0);
    for (there, back) in evaluate(brdf, rus32k()).iter().zip(evaluate(brdf, &swapped)) {
        for channel in 0..3 {
            difference += (f64::from(there[channel]) - f64::from(back[channel])).abs();
            total += f64::from(there[channel]);
        }
    }
    if total > 0.0 { difference / total } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{ggx::Ggx, lambert::Lambert};

    /// f = cos θ_o − shift, before and after the clamp.
    struct Tilted(f32);

    impl Brdf for Tilted {
        fn eval(&self, at: Directions) -> Rgb {
            Rgb::splat((at.view.z - self.0).max(0.0))
        }

        fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
            for (at, out) in at.iter().zip(out) {
                *out = Rgb([1.0, at.view.z - self.0, 1.0]);
            }
        }
    }

    #[test]
    fn light_from_nothing_is_found_whatever_the_viewers_azimuth() {
        struct Across;

        impl Brdf for Across {
            fn eval(&self, at: Directions) -> Rgb {
                Rgb::splat(if at.view.y.abs() > at.view.x.abs() { 0.5 } else { 0.1 })
            }
        }

        assert!(albedo_max(&Across) < 0.4, "{}", albedo_max(&Across));
        assert!((albedo_max_around(&Across) - 1.57).abs() < 0.01, "{}", albedo_max_around(&Across));
    }

    #[test]
    fn lambert_reflects_its_albedo_in_every_direction() {
        let colour = Rgb([0.9, 0.5, 0.1]);
        for theta in [0.0, 0.7, 1.48] {
            let albedo = directional_albedo(&Lambert { albedo: colour }, theta);
            assert!(albedo.zip(colour, |a, b| (a - b).abs()).max() < 1e-6, "{albedo:?}");
        }
        assert!((albedo_max(&Lambert { albedo: colour }) - 0.9).abs() < 1e-6);
    }

    #[test]
    fn formulas_are_physical() {
        let ggx = Ggx { diffuse: Rgb([0.2, 0.15, 0.1]), f0: Rgb::splat(0.04), alpha: 0.3 };
        let physics = Physics::of(&ggx);
        assert_eq!(physics.negative_share, 0.0);
        assert!(physics.reciprocity < 1e-5 && physics.albedo_max < 1.0, "{physics:?}");
    }

    #[test]
    fn values_below_zero_are_seen_before_the_clamp() {
        assert_eq!(negative_share(&Tilted(0.0)), 0.0);
        assert_eq!(negative_share(&Tilted(1.1)), 1.0);
        let views = rus32k().iter().filter(|at| at.view.z < 0.5).count();
        assert_eq!(negative_share(&Tilted(0.5)), views as f64 / rus32k().len() as f64);
    }

    #[test]
    fn a_material_that_only_minds_the_viewer_is_not_reciprocal() {
        assert!(reciprocity(&Tilted(0.0)) > 0.1);
        assert_eq!(reciprocity(&Lambert { albedo: Rgb::BLACK }), 0.0);
    }
}
