//! Where the alternation starts: a diffuse base, and D alone.

use super::fit::Unknowns;
use super::sites::{Site, Sites};
use crate::brdf::factored::{ENTRIES, NODES};

/// Share of the values that are below the first guess of ρ_d.
const BASE: f64 = 0.2;
/// Cosines of places where the base is looked for: away from the horizon, where every material brightens.
const STEEP: f64 = 0.3;
/// Roughness of the surface that G starts as.
const ROUGHNESS: f64 = 0.5;
/// The smallest unit: what is darker is black.
const DARKEST: f64 = 1e-6;

/// Unknowns to begin with, and the unit of each.
///
/// F = 1, G is Smith's term of GGX. D is the weighted least-squares answer with these, by the weights that make the
/// square of a whole value that of its logarithm: (ln(1 + f c) / f)². Its unit is the D that would do without a base: what
/// an entry has to explain at all.
pub(super) fn start(sites: &Sites, values: &[f64]) -> (Unknowns, Unknowns) {
    let diffuse = base(sites, values);
    let without = |diffuse: f64| Unknowns { diffuse, tables: [vec![0.0; ENTRIES], vec![1.0; ENTRIES], shadowing()] };
    let [mut unknowns, mut unit] = [diffuse, 0.0].map(without);
    for unknowns in [&mut unknowns, &mut unit] {
        unknowns.tables[0] = distribution(unknowns, sites, values);
    }
    unit.tables[0].iter_mut().for_each(|entry| *entry = entry.max(DARKEST));
    unit.tables[2] = vec![1.0; NODES];
    unit.diffuse = diffuse.max(DARKEST);
    (unknowns, unit)
}

/// D that explains what the base does not.
fn distribution(unknowns: &Unknowns, sites: &Sites, values: &[f64]) -> Vec<f64> {
    let [mut above, mut below] = [[0.0; ENTRIES]; 2];
    for (site, &f) in sites.sites.iter().zip(values).filter(|(_, f)| **f > 0.0) {
        let weight = ((f * site.cosine).ln_1p() / f).powi(2);
        let slope = slope(unknowns, site);
        let (low, t) = site.places[0];
        for (k, share) in [(low, 1.0 - t), (low + 1, t)] {
            above[k] += share * weight * slope * (f - unknowns.diffuse);
            below[k] += share * weight * slope * slope;
        }
    }
    above.iter().zip(&below).map(|(above, below)| if *below > 0.0 { (above / below).max(0.0) } else { 0.0 }).collect()
}

/// ∂f/∂D of a pair.
fn slope(unknowns: &Unknowns, site: &Site) -> f64 {
    let [_, fresnel, light, view] = unknowns.read(site);
    fresnel * light * view * site.over
}

fn base(sites: &Sites, values: &[f64]) -> f64 {
    let steep = |site: &Site| site.cosine > STEEP && site.over * site.cosine < 1.0 / STEEP;
    let mut seen: Vec<f64> = sites.sites.iter().zip(values).filter(|(site, _)| steep(site)).map(|(_, &f)| f).collect();
    seen.sort_by(f64::total_cmp);
    seen.get((BASE * seen.len() as f64) as usize).copied().unwrap_or(0.0)
}

/// G₁ of GGX (B. Walter et al. 2007, eq. 34), from the horizon to the normal.
fn shadowing() -> Vec<f64> {
    let a2 = ROUGHNESS * ROUGHNESS;
    let at = |k: usize| {
        let cosine = (std::f64::consts::FRAC_PI_2 * k as f64 / ENTRIES as f64).sin();
        2.0 * cosine / (cosine + (a2 + (1.0 - a2) * cosine * cosine).sqrt())
    };
    (0..NODES).map(at).collect()
}
