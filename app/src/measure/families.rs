//! Families of analytic materials in which the true in-between is known (PROTOCOL, "Interpolation quality").
//!
//! Four things that move, each with four lobes. Training has seen walks between materials of two of the lobes; the other
//! two are kept out (`families.rs` draws neither).

use anyhow::Result;
use nbrdf_core::brdf::lobed::Lobed;
use nbrdf_core::brdf::microfacet::{Distribution, f0_from_ior};
use nbrdf_core::metric::log_error;
use nbrdf_core::nbrdf::fit::{FitOptions, fit, random_network};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Interpolation, Material, Rgb, Weights};

/// Parameters tried when looking for the best match.
const CANDIDATES: u8 = 64;
/// Steps of the networks fitted to the ends.
const FIT_STEPS: usize = 10_000;

/// A lobe of the families.
pub struct FamilyLobe {
    /// Name in reports.
    pub name: &'static str,
    /// Whether training sees materials of this lobe.
    pub trained: bool,
    distribution: Distribution,
}

/// The lobes.
pub const LOBES: [FamilyLobe; 4] = [
    FamilyLobe { name: "ggx", trained: true, distribution: Distribution::Gtr { gamma: 2.0 } },
    FamilyLobe { name: "blinn_phong", trained: true, distribution: Distribution::BlinnPhong },
    FamilyLobe { name: "beckmann", trained: false, distribution: Distribution::Beckmann },
    FamilyLobe { name: "gtr1", trained: false, distribution: Distribution::Gtr { gamma: 1.0 } },
];

/// One moving parameter, from t = 0 to 1.
pub struct Family {
    /// Name in reports.
    pub name: &'static str,
    /// Diffuse albedo, F₀ and α of both ends; α, F₀ and albedo are linear between, but for `ior`.
    ends: [([f32; 3], [f32; 3], f32); 2],
    /// Index of refraction of both ends, where that is what moves.
    ior: Option<[f32; 2]>,
}

/// F₀ of n = 1.5.
const GLASS: [f32; 3] = [0.04; 3];

/// The four families.
pub const FAMILIES: [Family; 4] = [
    Family { name: "roughness", ends: [([0.2, 0.15, 0.1], GLASS, 0.1), ([0.2, 0.15, 0.1], GLASS, 0.6)], ior: None },
    Family { name: "colour", ends: [([0.6, 0.1, 0.1], GLASS, 0.3), ([0.1, 0.2, 0.6], GLASS, 0.3)], ior: None },
    Family { name: "ior", ends: [([0.3; 3], GLASS, 0.2), ([0.3; 3], GLASS, 0.2)], ior: Some([1.3, 2.0]) },
    Family { name: "metal", ends: [([0.4, 0.05, 0.05], GLASS, 0.3), ([0.0; 3], [1.0, 0.77, 0.34], 0.3)], ior: None },
];

impl Family {
    fn at(&self, t: f32, lobe: &FamilyLobe) -> Lobed {
        let end = |(diffuse, f0, alpha): ([f32; 3], [f32; 3], f32)| Lobed {
            diffuse: Rgb(diffuse),
            f0: Rgb(f0),
            alpha,
            distribution: lobe.distribution,
        };
        let member = end(self.ends[0]).towards(&end(self.ends[1]), t);
        match self.ior {
            Some([from, to]) => Lobed { f0: Rgb::splat(f0_from_ior(from + t * (to - from))), ..member },
            None => member,
        }
    }
}

/// A family with networks fitted to its ends, as any material would come.
pub struct FittedFamily {
    /// What moves.
    pub family: &'static Family,
    /// With which lobe.
    pub lobe: &'static FamilyLobe,
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
    /// Every family with every lobe, to be fitted.
    pub fn all() -> Vec<(&'static Family, &'static FamilyLobe)> {
        LOBES.iter().flat_map(|lobe| FAMILIES.iter().map(move |family| (family, lobe))).collect()
    }

    /// Fits both ends, each from a random start of its own; none if cancelled, or if a fit diverges.
    pub fn fit(
        (family, lobe): (&'static Family, &'static FamilyLobe),
        seed: u64,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let end = |index: u8| {
            let truth = family.at(f32::from(index), lobe);
            let options = FitOptions { steps: FIT_STEPS, seed, ..FitOptions::default() };
            let start = random_network(seed, 500 + u64::from(index));
            let network = fit(&start, &truth, options, cancelled)?;
            Some(Material::from_network(format!("{}-{}-{index}", lobe.name, family.name), network))
        };
        Some(Self { family, lobe, ends: [end(0)?, end(1)?] })
    }

    /// Walks to the middle with a method.
    pub fn middle_error(&self, method: &dyn Interpolation) -> Result<MiddleError> {
        let middle = method.between(&self.ends)?.at(&Weights::two(0.5))?;
        let found = evaluate(middle.as_ref(), rus32k());
        let error = |t: f32| log_error(rus32k(), &evaluate(&self.family.at(t, self.lobe), rus32k()), &found);
        let best = (0..=CANDIDATES).map(|k| error(f32::from(k) / f32::from(CANDIDATES))).fold(f64::INFINITY, f64::min);
        Ok(MiddleError { truth: error(0.5), best })
    }
}
