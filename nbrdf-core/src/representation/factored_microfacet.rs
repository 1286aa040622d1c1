//! A diffuse base and a microfacet lobe whose factors are tables, fitted to each material by itself.
//!
//! M. Bagher, J. Snyder, D. Nowrouzezahrai, *A Non-Parametric Factor Microfacet Model for Isotropic BRDFs* (2016),
//! doi 10.1145/2907941: 3 × (2 + 3 × 90) numbers, 3.2 KB. Nothing is shared between materials and nothing is learned.
//! How a code is found and what differs from the paper is told in [`fit`]; what it means in [`factored`](crate::brdf::factored).

mod fit;
mod scale;
mod sites;
mod start;

use rayon::prelude::*;

use super::{Code, DecodeError, EncodeError, Representation};
use crate::brdf::factored::{ENTRIES, Factored, Factors};
use crate::sampling::evaluate;
use crate::{Brdf, Material};
use sites::Sites;

/// Numbers of one channel: ρ_d, ρ_s, D, F, G.
const CHANNEL: usize = 2 + 3 * ENTRIES;
/// Numbers in a code: red, green, blue.
pub const DIM: usize = 3 * CHANNEL;
/// Codes depend on nothing but where the entries of D, F and G are.
const CHECKPOINT: &str = "90-90-90";

/// The representation. A code holds, channel by channel, ρ_d \[1/sr\], ρ_s, and 90 entries each of D, F and G as in
/// [`Factors`]; what is below 0 counts as 0.
///
/// Scales that could be moved from one factor to another are fixed: D \[1/sr\] covers the surface exactly once,
/// ∫ D cos θ dω = 1, as facets do; F and G have mean 1, weighted by the cosine, so that their ends near the horizon, known
/// least, count least. ρ_s carries what remains. A material without a lobe has ρ_s = 0 and factors without features.
#[derive(Clone, Copy, Debug, Default)]
pub struct FactoredMicrofacet;

impl Representation for FactoredMicrofacet {
    fn name(&self) -> &'static str {
        "factored_microfacet"
    }

    fn dim(&self) -> usize {
        DIM
    }

    fn checkpoint(&self) -> &str {
        CHECKPOINT
    }

    fn shared_bytes(&self) -> usize {
        0
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let sites = Sites::all();
        let values = evaluate(target.brdf.as_ref(), &sites.at);
        if !values.iter().all(|f| f.is_finite()) {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        }
        let channel = |channel: usize| {
            let values: Vec<f64> = values.iter().map(|f| f64::from(f[channel].max(0.0))).collect();
            scale::factors(&fit::fit(sites, &values).unknowns)
        };
        let channels: Vec<Factors> = (0..3).into_par_iter().map(channel).collect();
        Ok(self.code(channels.iter().flat_map(numbers).collect()))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        let numbers = code.checked(self.name(), CHECKPOINT, DIM)?;
        let channel = |channel: usize| factors(&numbers[channel * CHANNEL..][..CHANNEL]);
        Ok(Box::new(Factored::new(&[0, 1, 2].map(channel))))
    }
}

/// One channel as a part of a code.
fn numbers(factors: &Factors) -> impl Iterator<Item = f32> {
    let tables = [&factors.distribution, &factors.fresnel, &factors.shadowing];
    [factors.diffuse, factors.specular].into_iter().chain(tables.into_iter().flatten().copied())
}

/// The inverse of [`numbers`].
fn factors(numbers: &[f32]) -> Factors {
    let table = |index: usize| std::array::from_fn(|k| numbers[2 + index * ENTRIES + k]);
    Factors {
        diffuse: numbers[0],
        specular: numbers[1],
        distribution: table(0),
        fresnel: table(1),
        shadowing: table(2),
    }
}

#[cfg(test)]
mod tests;
