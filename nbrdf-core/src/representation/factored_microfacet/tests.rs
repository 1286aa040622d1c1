use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

use super::*;
use crate::brdf::ggx::Ggx;
use crate::brdf::lambert::Lambert;
use crate::brdf::microfacet::{ggx_distribution, schlick};
use crate::metric::{LogError, Metric};
use crate::{Directions, Rgb};

/// A GGX lobe over a base, with the shadowing of each side by itself: every factor has one argument.
struct Separable;

const BASE: Rgb = Rgb([0.1, 0.05, 0.02]);
const F0: Rgb = Rgb([0.04, 0.3, 0.9]);
const ALPHA: f32 = 0.25;

impl Brdf for Separable {
    fn eval(&self, at: Directions) -> Rgb {
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let half = (at.light + at.view).normalize();
        let a2 = ALPHA * ALPHA;
        // G₁ / (2 cos θ)
        let side = |cosine: f32| 1.0 / (cosine + (a2 + (1.0 - a2) * cosine * cosine).sqrt());
        let lobe = ggx_distribution(half, ALPHA) * side(at.light.z) * side(at.view.z);
        BASE.zip(schlick(F0, at.light.dot(half)), |base, fresnel| base + lobe * fresnel)
    }
}

fn encoded(brdf: impl Brdf) -> [Factors; 3] {
    let code = FactoredMicrofacet.encode(&Material::new("test", Arc::new(brdf))).unwrap();
    [0, 1, 2].map(|channel| factors(&code.code[channel * CHANNEL..][..CHANNEL]))
}

#[test]
fn a_lobe_of_separable_factors_is_met() {
    let found = encoded(Separable);
    let error = LogError.distance(&Separable, &Factored::new(&found));
    println!("log_error {error:.5}");
    assert!(error < 2.5e-3, "{error}");
}

#[test]
fn a_diffuse_material_has_a_base_and_no_lobe() {
    let found = encoded(Lambert { albedo: Rgb([0.8, 0.1, 0.0]) });
    for (factors, albedo) in found.iter().zip([0.8, 0.1, 0.0]) {
        assert!((factors.diffuse - albedo * FRAC_1_PI).abs() < 1e-6, "{}", factors.diffuse);
        assert_eq!(factors.specular, 0.0);
        assert!(factors.fresnel == [1.0; ENTRIES] && factors.shadowing == [1.0; ENTRIES]);
    }
}

#[test]
fn the_loss_never_rises_and_falls_far() {
    let ggx = Ggx { diffuse: Rgb::splat(0.3), f0: Rgb::splat(0.2), alpha: 0.15 };
    let sites = Sites::all();
    let values: Vec<f64> = evaluate(&ggx, &sites.at).iter().map(|f| f64::from(f[0])).collect();
    let losses = fit::fit(sites, &values).losses;
    println!("{} steps, {:.5} to {:.5}", losses.len() - 1, losses[0], losses[losses.len() - 1]);
    assert!(losses.len() > 3 && losses.windows(2).all(|pair| pair[1] < pair[0]), "{losses:?}");
    assert!(losses[losses.len() - 1] < 0.3 * losses[0], "{losses:?}");
}

#[test]
fn codes_take_3264_bytes_and_come_back_as_factors() {
    let numbers_of: Vec<f32> = (0..CHANNEL).map(|k| k as f32).collect();
    assert_eq!(numbers(&factors(&numbers_of)).collect::<Vec<f32>>(), numbers_of);
    assert_eq!(DIM * size_of::<f32>(), 3264);
}

#[test]
fn the_brightest_material_has_a_code_that_is_read() {
    for albedo in [f32::MAX, 1e9, f32::MIN_POSITIVE] {
        let material = Material::new("extreme", Arc::new(Lambert { albedo: Rgb::splat(albedo) }));
        let code = FactoredMicrofacet.encode(&material).unwrap();
        assert!(FactoredMicrofacet.decode(&code).is_ok(), "{albedo}");
    }
}

#[test]
fn materials_that_are_not_finite_are_refused() {
    let broken = Lambert { albedo: Rgb([f32::NAN, 0.1, 0.1]) };
    let refused = FactoredMicrofacet.encode(&Material::new("broken", Arc::new(broken)));
    assert!(matches!(refused, Err(EncodeError::NotFinite { material }) if material == "broken"));
}
