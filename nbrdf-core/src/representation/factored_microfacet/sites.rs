//! Where a material is asked, and which entries of the factors answer there.

use std::sync::OnceLock;

use crate::Directions;
use crate::brdf::factored::{ENTRIES, NODES, places, split};
use crate::sampling::{even_shares, half_difference};

/// Pairs asked.
const COUNT: usize = 15_000;

/// A factor of the lobe; as an index into what there is one of for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Factor {
    /// D, by θ_half.
    Distribution,
    /// F, by θ_diff.
    Fresnel,
    /// G from the horizon to the normal, where its first entry is 0 for good.
    Shadowing,
}

impl Factor {
    pub const ALL: [Self; 3] = [Self::Distribution, Self::Fresnel, Self::Shadowing];

    pub const fn entries(self) -> usize {
        match self {
            Self::Distribution | Self::Fresnel => ENTRIES,
            Self::Shadowing => NODES,
        }
    }
}

/// A place in a table: the entry below it, and the weight of the one above.
pub(super) type Place = (usize, f64);

/// One pair.
pub(super) struct Site {
    /// Of D, F, G(θ_i) and G(θ_o).
    pub places: [Place; 4],
    /// cos θ_i.
    pub cosine: f64,
    /// 1 / (cos θ_i cos θ_o).
    pub over: f64,
}

/// All pairs, the same for every material.
pub(super) struct Sites {
    pub at: Vec<Directions>,
    pub sites: Vec<Site>,
}

impl Sites {
    /// Spaced as MERL's cells are: θ_half by the square root, the others evenly; evenly scattered instead of at the
    /// middles of cells, so that a fit is judged between its entries as well. φ_diff over the whole circle, since
    /// materials that are networks are not symmetric to the last digit.
    pub fn all() -> &'static Self {
        static SITES: OnceLock<Sites> = OnceLock::new();
        SITES.get_or_init(|| {
            let pairs = even_shares().map(|[half, diff, around]| half_difference([half * half, diff, around]));
            let at: Vec<Directions> = pairs.filter(|at| at.is_above()).take(COUNT).collect();
            let sites = at.iter().zip(places(&at)).map(|(at, places)| Site::new(at, places)).collect();
            Self { at, sites }
        })
    }
}

impl Site {
    fn new(at: &Directions, [half, diff, light, view]: [f32; 4]) -> Self {
        let entry = |(low, t): (usize, f32)| (low, f64::from(t));
        let [cosine, other] = [at.light.z, at.view.z].map(f64::from);
        Self {
            places: [
                entry(split::<ENTRIES>(half)),
                entry(split::<ENTRIES>(diff)),
                entry(split::<NODES>(light)),
                entry(split::<NODES>(view)),
            ],
            cosine,
            over: 1.0 / (cosine * other),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_asked_for_and_none_is_a_metrics() {
        let sites = Sites::all();
        assert_eq!(sites.at.len(), COUNT);
        for (index, entries) in [ENTRIES, ENTRIES, NODES].into_iter().enumerate() {
            let mut asked = vec![0.0; entries];
            for site in &sites.sites {
                let (low, t) = site.places[index];
                asked[low] += 1.0 - t;
                asked[low + 1] += t;
            }
            // Few pairs with θ_half next to the horizon have both directions above it.
            let least = asked[1..entries - 4].iter().copied().fold(f64::INFINITY, f64::min);
            assert!(least > 10.0 && asked.iter().all(|&asked| asked > 0.0), "{index}: {asked:?}");
        }
        let near = |a: &Directions, b: &Directions| (a.light - b.light).length() + (a.view - b.view).length() < 1e-4;
        let metrics = crate::sampling::rus32k();
        assert!(sites.at.iter().step_by(97).all(|at| !metrics.iter().any(|metric| near(at, metric))));
    }
}
