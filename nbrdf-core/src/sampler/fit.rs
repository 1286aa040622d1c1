//! The lobe of a material, by direct search: the one whose samples vary least.
//!
//! min over (s, α) of the mean over viewers of ln M, with M the relative second moment of the one-sample estimator
//! (see `outgoing`). The logarithm keeps one viewer whom no lobe serves from deciding for all. Differs from
//! Sztrajman et al. (2021, doi 10.1111/cgf.14335), who fit an analytic model to the reflectance: what samples most
//! like a material need not look most like it.

use std::f64::consts::PI;

use super::lobe::{Lobe, MAX_SHARE, MAX_WIDTH, MIN_WIDTH};
use super::mixture::{Glossy, above, share_towards};
use super::outgoing::Outgoing;
use super::visible_normals::VisibleNormals;
use crate::Brdf;

/// Widths tried first, evenly spaced in ln α: a highlight and its haze each have a valley of their own.
const WIDTHS: u32 = 16;
/// Steps of golden section: ln α to 0.001, the share to 0.001.
const STEPS: u32 = 14;

impl Lobe {
    /// The lobe of least variance for this material, averaged over viewers at θ_o = 0, 10, ..., 80°.
    ///
    /// Deterministic; evaluates the material some 20 000 times. [`Lobe::COSINE`] where it is black or not finite.
    pub fn fit(brdf: &dyn Brdf) -> Self {
        let seen = Outgoing::towards_viewers(brdf).unwrap_or_default();
        search(&seen, |alpha| VisibleNormals { alpha })
            .map_or(Self::COSINE, |(share, width)| Self { share: share as f32, width: width as f32 })
    }
}

/// Share and width of the best lobe of a family; none where no lobe beats the cosine alone.
pub(super) fn search<G: Glossy>(seen: &[Outgoing], family: impl Fn(f64) -> G) -> Option<(f64, f64)> {
    if seen.is_empty() {
        return None;
    }
    let best_share = |log_width: f64| {
        let lobe = family(log_width.exp());
        let contrasts: Vec<Vec<f64>> = seen.iter().map(|outgoing| contrast(outgoing, &lobe)).collect();
        golden_section([0.0, f64::from(MAX_SHARE)], |share| mean_log_moment(seen, &contrasts, share))
    };
    let (low, high) = (f64::from(MIN_WIDTH).ln(), f64::from(MAX_WIDTH).ln());
    let step = (high - low) / f64::from(WIDTHS - 1);
    let coarse = (0..WIDTHS).map(|k| low + step * f64::from(k)).map(|width| (width, best_share(width).1));
    let (start, _) = coarse.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let (width, _) = golden_section([(start - step).max(low), (start + step).min(high)], |width| best_share(width).1);
    let (share, moment) = best_share(width);
    let cosine = seen.iter().map(|outgoing| outgoing.moments.iter().sum::<f64>().ln()).sum::<f64>();
    (moment * (seen.len() as f64) < cosine).then(|| (share, width.exp()))
}

/// Density of the lobe relative to the cosine's, less 1, at every light.
pub(super) fn contrast(outgoing: &Outgoing, lobe: &impl Glossy) -> Vec<f64> {
    let relative = |light, view| match (above(light), above(view)) {
        (Some(light), Some(view)) => PI * lobe.density(light, view) / light.z - 1.0,
        _ => 0.0,
    };
    outgoing.at.iter().map(|at| relative(at.light, at.view)).collect()
}

/// The mean over viewers of ln M.
pub(super) fn mean_log_moment(seen: &[Outgoing], contrasts: &[Vec<f64>], share: f64) -> f64 {
    let of_viewer = |(outgoing, contrast): (&Outgoing, &Vec<f64>)| {
        let share = share_towards(share as f32, f64::from(outgoing.at[0].view.z));
        let terms = outgoing.moments.iter().zip(contrast).map(|(moment, contrast)| moment / (1.0 + share * contrast));
        terms.sum::<f64>().ln()
    };
    seen.iter().zip(contrasts).map(of_viewer).sum::<f64>() / seen.len() as f64
}

/// Where a function with one valley is least, and its value there (J. Kiefer, 1953,
/// doi 10.1090/S0002-9939-1953-0055639-3); the interval shrinks to 0.618^[`STEPS`] of itself.
fn golden_section([mut low, mut high]: [f64; 2], f: impl Fn(f64) -> f64) -> (f64, f64) {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let probe = |x: f64| (x, f(x));
    let mut left = probe(high - golden * (high - low));
    let mut right = probe(low + golden * (high - low));
    for _ in 0..STEPS {
        if left.1 <= right.1 {
            (high, right) = (right.0, left);
            left = probe(high - golden * (high - low));
        } else {
            (low, left) = (left.0, right);
            right = probe(low + golden * (high - low));
        }
    }
    if left.1 <= right.1 { left } else { right }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{ggx::Ggx, lambert::Lambert};
    use crate::{Directions, Rgb};

    #[test]
    fn a_lobe_of_ggx_is_found_again() {
        for alpha in [0.002, 0.03, 0.3] {
            let metal = Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(1.0), alpha };
            let lobe = Lobe::fit(&metal);
            assert!((lobe.width / alpha - 1.0).abs() < 0.15 && lobe.share > 0.85, "α = {alpha}: {lobe:?}");
        }
    }

    #[test]
    fn a_highlight_of_little_energy_gets_a_small_share() {
        let plastic = Ggx { diffuse: Rgb::splat(0.8), f0: Rgb::splat(0.04), alpha: 0.05 };
        let lobe = Lobe::fit(&plastic);
        assert!(lobe.share > 0.02 && lobe.share < 0.2, "{lobe:?}");
    }

    #[test]
    fn a_material_without_a_highlight_is_sampled_by_the_cosine() {
        let lobe = Lobe::fit(&Lambert { albedo: Rgb::splat(0.5) });
        assert!(lobe.share < 0.01, "{lobe:?}");
    }

    #[test]
    fn a_material_that_is_black_or_not_finite_is_sampled_by_the_cosine() {
        struct Constant(f32);
        impl Brdf for Constant {
            fn eval(&self, _: Directions) -> Rgb {
                Rgb::splat(self.0)
            }
        }
        for value in [0.0, f32::NAN, f32::INFINITY, f32::MAX] {
            assert_eq!(Lobe::fit(&Constant(value)).share, 0.0, "{value}");
        }
    }

    #[test]
    fn golden_section_finds_a_valley_inside_and_at_either_end() {
        for valley in [0.0, 0.3, 1.0] {
            let (at, _) = golden_section([0.0, 1.0], |x| (x - valley).abs());
            assert!((at - valley).abs() < 2e-3, "{at}");
        }
    }
}
