//! The shifted gamma distribution: ten numbers for each channel, ln ρ_d, ln ρ_s κ, ln (F₀ − F₁), ln F₀, the logits of
//! ln α and of p, ln λ, the logits of ln c^(−1/k), of ln k and of θ₀.
//!
//! M. Bagher et al. (2012, see [`brdf::sgd`](crate::brdf::sgd)) also fit every channel on its own by Levenberg–Marquardt.
//! Differs: the loss of [`analytic`](super), several starts, and F₀ and F₀ − F₁ not negative, which keeps F so:
//! F = (F₀ − F₁) u + F₀ ((1 − u) − (1 − u)⁵) + (1 − u)⁵ with u = cos θ_diff.

use rayon::prelude::*;

use super::Parametric;
use super::fit::Problem;
use super::number::{between, log_between, of_between, of_log_between, of_positive, positive};
use super::target::Target;
use crate::brdf::sgd::{Sgd, Shadowing, ShiftedGamma};
use crate::{Brdf, Rgb};

/// Numbers of one channel.
const CHANNEL: usize = 10;
const ALPHA: [f32; 2] = [1e-6, 10.0];
const P: [f32; 2] = [0.0, 3.0];
/// \[rad\]
const REACH: [f32; 2] = [0.02, 50.0];
const K: [f32; 2] = [0.5, 1000.0];
/// \[rad\]
const THETA0: [f32; 2] = [-1.57, 1.57];

/// Three channels of the shifted gamma distribution.
pub struct SgdLobes;

impl Parametric for SgdLobes {
    const NAME: &'static str = "sgd";
    const DIM: usize = 3 * CHANNEL;

    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf> {
        Box::new(Sgd { channels: [0, 1, 2].map(|channel| of_numbers(&numbers[channel * CHANNEL..][..CHANNEL])) })
    }

    fn fit(target: &Target) -> Vec<f32> {
        let starts = starts(target);
        (0..3).into_par_iter().flat_map_iter(|channel| solve(target, channel, &starts[channel])).collect()
    }
}

fn of_numbers(numbers: &[f32]) -> ShiftedGamma {
    let (facing, f0) = (positive(numbers[2]), positive(numbers[3]));
    ShiftedGamma {
        diffuse: positive(numbers[0]),
        specular: positive(numbers[1]),
        f0,
        f1: f0 - facing,
        alpha: log_between(numbers[4], ALPHA),
        p: between(numbers[5], P),
        shadowing: Shadowing {
            lambda: positive(numbers[6]),
            reach: log_between(numbers[7], REACH),
            k: log_between(numbers[8], K),
            theta0: between(numbers[9], THETA0),
        },
    }
}

fn numbers_of(channel: &ShiftedGamma) -> Vec<f32> {
    let Shadowing { lambda, reach, k, theta0 } = channel.shadowing;
    vec![
        of_positive(channel.diffuse),
        of_positive(channel.specular),
        of_positive(channel.f0 - channel.f1),
        of_positive(channel.f0),
        of_log_between(channel.alpha, ALPHA),
        of_between(channel.p, P),
        of_positive(lambda),
        of_log_between(reach, REACH),
        of_log_between(k, K),
        of_between(theta0, THETA0),
    ]
}

/// The numbers of one channel.
fn solve(target: &Target, channel: usize, starts: &[Vec<f32>]) -> Vec<f32> {
    let places = target.places;
    // The channels of a reflectance evaluate three codes at once.
    let of_three = |points: &[Vec<f32>]| {
        let sgd = Sgd { channels: [0, 1, 2].map(|i| of_numbers(&points[i.min(points.len() - 1)])) };
        let mut values = vec![Rgb::BLACK; places.at.len()];
        sgd.eval_prepared(&places.at, &mut values);
        let logs = places.logs(&values);
        (0..points.len()).map(|i| logs.iter().skip(i).step_by(3).copied().collect()).collect::<Vec<Vec<f32>>>()
    };
    let all = |points: &[Vec<f32>]| points.chunks(3).flat_map(of_three).collect::<Vec<_>>();
    let wanted: Vec<f32> = target.logs.iter().skip(channel).step_by(3).copied().collect();
    Problem { logs: all, target: &wanted, weights: &places.weights }.solve(starts)
}

/// For each channel, lobes of several widths and tails, as bright as fits.
fn starts(target: &Target) -> [Vec<Vec<f32>>; 3] {
    let base = target.base();
    let albedo = Target::albedo(base);
    let mut starts = [(); 3].map(|()| Vec::new());
    for alpha in [3e-5, 3e-4, 3e-3, 3e-2, 0.3] {
        for p in [0.3, 1.0] {
            let shadowing = Shadowing { lambda: 3.0, reach: 1.3, k: 15.0, theta0: 0.1 };
            let shape = ShiftedGamma { diffuse: 0.0, specular: 1.0, f0: 0.2, f1: 0.1, alpha, p, shadowing };
            let bright = target.brightness(base, &Sgd { channels: [shape; 3] });
            for (channel, starts) in starts.iter_mut().enumerate() {
                let diffuse = albedo[channel];
                starts.push(numbers_of(&ShiftedGamma { diffuse, specular: bright[channel].max(1e-3), ..shape }));
            }
        }
    }
    starts
}
