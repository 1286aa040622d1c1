//! Which factor has which scale, so that codes can be compared.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, TAU};

use super::fit::Unknowns;
use crate::brdf::factored::{ENTRIES, Factors, LARGEST};

/// The factors, scaled as [`FactoredMicrofacet`](super::FactoredMicrofacet) says.
pub(super) fn factors(unknowns: &Unknowns) -> Factors {
    let [distribution, fresnel, shadowing] = &unknowns.tables;
    let shadowing: Vec<f64> = shadowing[1..].iter().rev().copied().collect();
    let scales = [area(distribution), mean(fresnel, 0.5), mean(&shadowing, 0.0)];
    let specular = scales[0] * scales[1] * scales[2] * scales[2];
    let lobe = specular > 0.0;
    let scaled = |table: &[f64], scale: f64, without: f64| {
        let entry = |k: usize| if lobe { table[k] / scale } else { without };
        std::array::from_fn::<f32, ENTRIES, _>(|k| stored(entry(k)))
    };
    Factors {
        diffuse: stored(unknowns.diffuse),
        specular: stored(specular),
        distribution: scaled(distribution, scales[0], FRAC_1_PI),
        fresnel: scaled(fresnel, scales[1], 1.0),
        shadowing: scaled(&shadowing, scales[2], 1.0),
    }
}

/// A number that is read back as what it is.
fn stored(number: f64) -> f32 {
    number.min(f64::from(LARGEST)) as f32
}

/// ∫ D cos θ dω, every entry over its cell.
fn area(distribution: &[f64]) -> f64 {
    // ∫ cos θ sin θ dθ from the normal to the upper edge of k cells.
    let inside = |k: usize| 0.5 * (FRAC_PI_2 * (k as f64 / ENTRIES as f64).powi(2)).sin().powi(2);
    let ring = |(k, d): (usize, &f64)| TAU * (inside(k + 1) - inside(k)) * d;
    distribution.iter().enumerate().map(ring).sum()
}

/// Mean weighted by the cosine, of entries at π/2 (k + `offset`)/90.
fn mean(table: &[f64], offset: f64) -> f64 {
    let cosine = |k: usize| (FRAC_PI_2 * (k as f64 + offset) / ENTRIES as f64).cos();
    let weights: f64 = (0..ENTRIES).map(cosine).sum();
    table.iter().enumerate().map(|(k, entry)| cosine(k) * entry).sum::<f64>() / weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_moved_between_factors_change_no_code() {
        let table = |count: usize, by: f64| (0..count).map(|k| by * (1.0 + (k as f64 * 0.7).sin())).collect();
        let unknowns = |by: [f64; 3]| Unknowns {
            diffuse: 0.2,
            tables: [table(ENTRIES, by[0]), table(ENTRIES, by[1]), table(ENTRIES + 1, by[2])],
        };
        let (plain, moved) = (factors(&unknowns([1.0; 3])), factors(&unknowns([8.0, 0.5, 0.5])));
        assert_eq!(plain, moved);
        assert_eq!(factors(&unknowns([2.0, 1.0, 1.0])).specular, 2.0 * plain.specular);
    }

    #[test]
    fn a_distribution_covers_the_surface_once() {
        let flat = vec![FRAC_1_PI; ENTRIES];
        assert!((area(&flat) - 1.0).abs() < 1e-12);
        let unknowns = Unknowns { diffuse: 0.0, tables: [flat, vec![3.0; ENTRIES], vec![2.0; ENTRIES + 1]] };
        let factors = factors(&unknowns);
        assert!((factors.specular - 12.0).abs() < 1e-5 && factors.fresnel == [1.0; ENTRIES]);
        assert_eq!(factors.shadowing, [1.0; ENTRIES]);
    }
}
