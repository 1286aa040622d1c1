//! Analytic materials for training: random ones, and random walks between two whose in-between is known.
//!
//! Lobes: GTR with tails of γ from 1.5 to 3 (2 is GGX) and Blinn–Phong. Beckmann and GTR of γ = 1 are never drawn: the
//! families of `measure/families.rs` that are kept out.

use std::sync::Arc;

use autoencoder::Walk;
use nbrdf_core::brdf::lobed::Lobed;
use nbrdf_core::brdf::microfacet::{Distribution, f0_from_ior};
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::{Brdf, Rgb};
use rand::{Rng, RngExt};

/// Dielectrics of any body colour and metals of any tint, α from .05 to .7.
pub fn random_materials(seed: u64, count: usize) -> Vec<Arc<dyn Brdf>> {
    let rng = &mut generator(seed, 7);
    (0..count).map(|_| Arc::new(random_material(rng)) as Arc<dyn Brdf>).collect()
}

/// Walks between two random materials of the same lobe along which one thing or everything changes, linearly.
pub fn random_walks(seed: u64, count: usize) -> Vec<Walk> {
    let rng = &mut generator(seed, 8);
    let mut one = || {
        let (start, other) = (random_material(rng), random_material(rng));
        let end = match rng.random_range(0..5) {
            0 => Lobed { alpha: other.alpha, ..start },
            1 => Lobed { diffuse: other.diffuse, ..start },
            2 => Lobed { f0: other.f0, ..start },
            3 => Lobed { diffuse: other.diffuse, f0: other.f0, ..start },
            _ => Lobed { distribution: start.distribution, ..other },
        };
        let t = rng.random_range(0.2..0.8);
        Walk { ends: [Arc::new(start), Arc::new(end)], t, between: Arc::new(start.towards(&end, t)) }
    };
    (0..count).map(|_| one()).collect()
}

fn random_material(rng: &mut impl Rng) -> Lobed {
    let alpha = 0.05 * 14f32.powf(rng.random_range(0.0..1.0));
    let brightness: f32 = rng.random_range(0.0f32..0.9).powi(2);
    let mut tint = |spread: f32| Rgb(std::array::from_fn(|_| 1.0 - spread * rng.random_range(0.0..1.0f32)));
    let (body, metal) = (tint(0.9), tint(0.5));
    let metalness = match rng.random_range(0.0..1.0) {
        kind if kind < 0.2 => rng.random_range(0.0..1.0f32),
        kind if kind < 0.35 => 1.0,
        _ => 0.0,
    };
    let dielectric = Rgb::splat(f0_from_ior(rng.random_range(1.2..2.2)));
    let distribution = match rng.random_range(0..3) {
        0 => Distribution::Gtr { gamma: 2.0 },
        1 => Distribution::Gtr { gamma: rng.random_range(1.5..3.0) },
        _ => Distribution::BlinnPhong,
    };
    Lobed {
        diffuse: body * (brightness * (1.0 - metalness)),
        f0: dielectric * (1.0 - metalness) + metal * metalness,
        alpha,
        distribution,
    }
}
