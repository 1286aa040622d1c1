//! No evaluation of any method gives NaN, infinity or less than nothing, wherever it is asked.
//!
//! `NBRDF_EVALUATIONS=100000000 cargo test --release --workspace --test finite -- --nocapture` asks 10⁸ times.

use std::sync::Arc;

use nbrdf::catalog::{Catalog, REPRESENTATIONS, Reference};
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::{Directions, Rgb, Vec3};
use rand::{Rng, RngExt};

/// Pairs asked at once.
const BATCH: usize = 4096;

/// A pair: most of unit vectors, in all directions, some next to the horizon, the normal or each other; one in four of
/// any finite numbers.
fn pair(rng: &mut impl Rng) -> Directions {
    let mut unit = || {
        let mut number = || rng.random_range(-1.0f32..1.0);
        Vec3::new(number(), number(), number()).try_normalize().unwrap_or(Vec3::Z)
    };
    let (light, view) = (unit(), unit());
    match rng.random_range(0..8) {
        0 => Directions::new(Vec3 { z: light.z * 1e-6, ..light }.normalize(), view),
        1 => Directions::new(light, Vec3::new(-light.x, -light.y, light.z)),
        2 => Directions::new(light, light),
        3 => Directions::new((Vec3::Z + light * 1e-5).normalize(), (Vec3::Z + view * 1e-7).normalize()),
        4 | 5 => {
            let mut any = || loop {
                let number = f32::from_bits(rng.random());
                if number.is_finite() {
                    return number;
                }
            };
            let mut vector = || Vec3::new(any(), any(), any());
            Directions::new(vector(), vector())
        }
        _ => Directions::new(light, view),
    }
}

#[test]
fn finite_directions_give_finite_reflectances_of_every_method() {
    let asked = std::env::var("NBRDF_EVALUATIONS").ok().and_then(|count| count.parse().ok()).unwrap_or(2_000_000usize);
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let materials = ["chrome", "blue-fabric", "rgl/paper_white"];
    let materials = materials.map(|name| builtin::shared().get(name).unwrap().material());
    let batches = asked.div_ceil(BATCH * REPRESENTATIONS.len() * materials.len());
    let mut count = 0;
    for (stream, entry) in REPRESENTATIONS.iter().enumerate() {
        let representation = entry.build(&catalog).unwrap();
        let rng = &mut generator(0, stream as u64);
        let mut out = vec![Rgb::BLACK; BATCH];
        for material in &materials {
            let brdf = representation.decode(&representation.encode(material).unwrap()).unwrap();
            for _ in 0..batches {
                let at: Vec<Directions> = (0..BATCH).map(|_| pair(rng)).collect();
                brdf.eval_into(&at, &mut out);
                for (at, f) in at.iter().zip(&out) {
                    assert!(f.is_finite() && f.min() >= 0.0, "{}: {f:?} at {at:?}", entry.name);
                }
                count += BATCH;
            }
            // One by one must be the same.
            let at = pair(rng);
            brdf.eval_into(&[at], &mut out[..1]);
            assert_eq!(out[0], brdf.eval(at), "{} at {at:?}", entry.name);
        }
    }
    println!("{count} evaluations of {} methods, all finite and not negative", REPRESENTATIONS.len());
    assert!(count >= asked);
}
