//! A diffuse base under one lobe with a free Fresnel term: ten numbers, ln k_d, ln F₀ and ln F₉₀ of each channel, and
//! the logit of ln α.

use rayon::prelude::*;

use super::Parametric;
use super::fit::Problem;
use super::number::{log_between, of_log_between, of_positive, positive_rgb};
use super::target::Target;
use crate::brdf::free_fresnel::{Facets, FreeFresnel};
use crate::{Brdf, Rgb};

/// Lobes of these widths are tried first.
pub(super) const WIDTHS: [f32; 6] = [0.005, 0.015, 0.05, 0.12, 0.3, 0.7];
/// Where α may be.
const ALPHA: [f32; 2] = [1e-3, 1.0];

/// A base under a lobe of GGX.
pub struct GgxLobe;

impl Parametric for GgxLobe {
    const NAME: &'static str = "lambert_ggx";
    const DIM: usize = 10;

    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf> {
        Box::new(of_numbers(numbers, Facets::Ggx))
    }

    fn fit(target: &Target) -> Vec<f32> {
        solve_together::<Self>(target, &starts(target, Facets::Ggx))
    }
}

/// A base under a lobe of Blinn–Phong.
pub struct BlinnPhongLobe;

impl Parametric for BlinnPhongLobe {
    const NAME: &'static str = "lambert_blinn_phong";
    const DIM: usize = 10;

    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf> {
        Box::new(of_numbers(numbers, Facets::BlinnPhong))
    }

    fn fit(target: &Target) -> Vec<f32> {
        solve_together::<Self>(target, &starts(target, Facets::BlinnPhong))
    }
}

fn of_numbers(numbers: &[f32], facets: Facets) -> FreeFresnel {
    FreeFresnel {
        diffuse: positive_rgb(&numbers[..3]),
        f0: positive_rgb(&numbers[3..6]),
        f90: positive_rgb(&numbers[6..9]),
        alpha: log_between(numbers[9], ALPHA),
        facets,
    }
}

/// One for each width: the base as seen, the lobe as bright as fits, grazing angles as bright or white.
fn starts(target: &Target, facets: Facets) -> Vec<Vec<f32>> {
    let base = target.base();
    let start = |alpha: f32| {
        let white = Rgb::splat(1.0);
        let shape = FreeFresnel { diffuse: Rgb::BLACK, f0: white, f90: white, alpha, facets };
        let f0 = target.brightness(base, &shape).map(|f0| f0.max(1e-3));
        let diffuse = Target::albedo(base);
        let logarithms = [diffuse, f0, f0.map(|f0| f0.max(0.3))].into_iter().flat_map(|rgb| rgb.map(of_positive).0);
        logarithms.chain([of_log_between(alpha, ALPHA)]).collect()
    };
    WIDTHS.map(start).to_vec()
}

/// The numbers of all channels, found together.
pub(super) fn solve_together<P: Parametric>(target: &Target, starts: &[Vec<f32>]) -> Vec<f32> {
    let places = target.places;
    let of_point = |point: &Vec<f32>| {
        let mut values = vec![Rgb::BLACK; places.at.len()];
        P::reflectance(point).eval_prepared(&places.at, &mut values);
        places.logs(&values)
    };
    let weights: Vec<f32> = places.weights.iter().flat_map(|weight| [weight / 3.0; 3]).collect();
    let all = |points: &[Vec<f32>]| points.par_iter().map(of_point).collect::<Vec<_>>();
    Problem { logs: all, target: &target.logs, weights: &weights }.solve(starts)
}
