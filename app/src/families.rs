//! Analytic materials: random ones for training, and families whose in-betweens are known.

use std::sync::Arc;

use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::brdf::microfacet::f0_from_ior;
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::{Brdf, Rgb};
use rand::RngExt;

/// Lambert + GGX materials: dielectrics of any diffuse colour and metals of any tint, α from .05 to .7.
pub fn random_materials(seed: u64, count: usize) -> Vec<Arc<dyn Brdf>> {
    let rng = &mut generator(seed, 7);
    let mut one = || {
        let alpha = 0.05 * 14f32.powf(rng.random_range(0.0..1.0));
        let brightness: f32 = rng.random_range(0.0f32..0.9).powi(2);
        let mut tint = |spread: f32| Rgb(std::array::from_fn(|_| 1.0 - spread * rng.random_range(0.0..1.0f32)));
        let (body, metal) = (tint(0.9), tint(0.5));
        let metalness = if rng.random_range(0.0..1.0) < 0.3 { rng.random_range(0.0..1.0f32) } else { 0.0 };
        let dielectric = Rgb::splat(f0_from_ior(rng.random_range(1.2..2.2)));
        Ggx {
            diffuse: body * (brightness * (1.0 - metalness)),
            f0: dielectric * (1.0 - metalness) + metal * metalness,
            alpha,
        }
    };
    (0..count).map(|_| Arc::new(one()) as Arc<dyn Brdf>).collect()
}
