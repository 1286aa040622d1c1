//! Families of analytic materials in which the true in-between is known (PROTOCOL, "Interpolation quality").

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::brdf::microfacet::f0_from_ior;
use nbrdf_core::metric::log_error;
use nbrdf_core::nbrdf::fit::{FitOptions, fit, random_network};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Brdf, Interpolation, Material, Rgb, Weights};

/// Parameters tried when looking for the best match.
const CANDIDATES: u8 = 64;
/// Steps of the networks fitted to the ends.
const FIT_STEPS: usize = 10_000;

/// One moving parameter; `at` is linear in it.
pub struct Family {
    /// Name in reports.
    pub name: &'static str,
    at: fn(f32) -> Ggx,
}

/// The four families, GGX lobe.
pub const FAMILIES: [Family; 4] = [
    Family { name: "roughness", at: |t| ggx([0.2, 0.15, 0.1], Rgb::splat(f0_from_ior(1.5)), 0.1 + 0.5 * t) },
    Family {
        name: "colour",
        at: |t| ggx([mix(0.6, 0.1, t), mix(0.1, 0.2, t), mix(0.1, 0.6, t)], Rgb::splat(f0_from_ior(1.5)), 0.3),
    },
    Family { name: "ior", at: |t| ggx([0.3; 3], Rgb::splat(f0_from_ior(mix(1.3, 2.0, t))), 0.2) },
    Family {
        name: "metal",
        at: |t| {
            let diffuse = [mix(0.4, 0.0, t), mix(0.05, 0.0, t), mix(0.05, 0.0, t)];
            ggx(diffuse, Rgb([mix(0.04, 1.0, t), mix(0.04, 0.77, t), mix(0.04, 0.34, t)]), 0.3)
        },
    },
];

fn mix(from: f32, to: f32, t: f32) -> f32 {
    from + t * (to - from)
}

fn ggx(diffuse: [f32; 3], f0: Rgb, alpha: f32) -> Ggx {
    Ggx { diffuse: Rgb(diffuse), f0, alpha }
}

/// A family with networks fitted to its ends, as any material would come.
pub struct FittedFamily {
    /// The family.
    pub family: &'static Family,
    ends: [Material; 2],
}

/// Errors of a method's middle.
pub struct MiddleError {
    /// `log_error` against the true middle.
    pub truth: f64,
    /// `log_error` against the member of the family that matches best, wherever it lies.
    pub best: f64,
}

impl FittedFamily {
    /// Fits both ends, each from a random start of its own.
    pub fn fit(family: &'static Family, seed: u64) -> Self {
        let end = |index: u8| {
            let truth = (family.at)(f32::from(index));
            let options = FitOptions { steps: FIT_STEPS, seed, ..FitOptions::default() };
            let start = random_network(seed, 500 + u64::from(index));
            let network = fit(&start, &truth, options, &|| false).unwrap_or(start);
            Material::from_network(format!("{}-{index}", family.name), network)
        };
        Self { family, ends: [end(0), end(1)] }
    }

    /// Walks to the middle with a method.
    pub fn middle_error(&self, method: &dyn Interpolation) -> Result<MiddleError> {
        let middle = method.between(&self.ends)?.at(&Weights::two(0.5))?;
        let found = evaluate(middle.as_ref(), rus32k());
        let error = |t: f32| {
            let member: Arc<dyn Brdf> = Arc::new((self.family.at)(t));
            log_error(rus32k(), &evaluate(member.as_ref(), rus32k()), &found)
        };
        let best = (0..=CANDIDATES).map(|k| error(f32::from(k) / f32::from(CANDIDATES))).fold(f64::INFINITY, f64::min);
        Ok(MiddleError { truth: error(0.5), best })
    }
}
