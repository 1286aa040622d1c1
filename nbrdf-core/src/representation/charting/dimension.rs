//! How many dimensions data have, at which scale.
//!
//! M. Brand, *Charting a Manifold*, section 2: within a ball of radius r around a point lie n(r) others, and
//! c(r) = d ln r / d ln n is 1/d at scales where a d-dimensional manifold is straight; less where noise adds dimensions,
//! and less where curvature does. The first peak of c(r), averaged over balls, gives d. Differs: ln n is replaced by the
//! digamma ψ(n), with which the mean of ln r over balls is a straight line also for small n.

use super::vector::squared_distance;

/// Balls that hold a number of points, averaged over all centres.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Growth {
    /// Other points in the ball.
    pub count: usize,
    /// Their radius, geometric mean.
    pub radius: f64,
    /// 1 / c(r).
    pub dimension: f64,
}

/// Ratio of the counts between which a slope is taken.
const OCTAVE: f64 = 2.0;

/// Growth over counts from 4 to half of the points, in steps of a quarter octave; empty for fewer than 16 points.
pub fn growth(points: &[Vec<f64>]) -> Vec<Growth> {
    let n = points.len();
    if n < 16 {
        return Vec::new();
    }
    let mut log_radius = vec![0.0; n - 1];
    for point in points {
        let mut squared: Vec<f64> = points.iter().map(|other| squared_distance(point, other)).collect();
        squared.sort_unstable_by(f64::total_cmp);
        let logs = squared[1..].iter().map(|squared| 0.5 * squared.max(f64::MIN_POSITIVE).ln());
        log_radius.iter_mut().zip(logs).for_each(|(sum, log)| *sum += log / n as f64);
    }
    let mut counts: Vec<usize> =
        (8..).map(|k| 2f64.powf(0.25 * f64::from(k)).round() as usize).take_while(|c| 2 * c <= n).collect();
    counts.dedup();
    let half = OCTAVE.sqrt();
    let one = |&count: &usize| {
        let first = (count as f64 / half).round() as usize;
        let last = ((count as f64 * half).round() as usize).min(n - 1);
        let pairs = || (first..=last).map(|k| (digamma(k), log_radius[k - 1]));
        Growth { count, radius: log_radius[count - 1].exp(), dimension: 1.0 / slope(pairs) }
    };
    counts.iter().map(one).collect()
}

/// The first peak of c(r): the dimension of the manifold where it is straightest. Where c(r) only rises, towards the data's
/// boundary, the smallest scale; none for no growth.
pub fn intrinsic_dimension(growth: &[Growth]) -> Option<Growth> {
    let peak =
        |window: &&[Growth]| window[1].dimension <= window[0].dimension && window[1].dimension <= window[2].dimension;
    growth.windows(3).find(peak).map(|window| window[1]).or_else(|| growth.first().copied())
}

/// ψ(k) = −γ + Σ 1/j, j < k.
fn digamma(k: usize) -> f64 {
    const EULER: f64 = 0.577_215_664_901_532_9;
    (1..k).map(|j| 1.0 / j as f64).sum::<f64>() - EULER
}

/// Slope of the straight line through (x, y) with the least squares.
fn slope<I: Iterator<Item = (f64, f64)>>(pairs: impl Fn() -> I) -> f64 {
    let count = pairs().count() as f64;
    let (x, y) = pairs().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / count, y + b / count));
    let (above, below) = pairs().fold((0.0, 0.0), |(p, s), (a, b)| (p + (a - x) * (b - y), s + (a - x) * (a - x)));
    above / below
}

#[cfg(test)]
mod tests {
    use rand::RngExt as _;

    use super::super::known::{sphere_patch, swiss_roll};
    use super::*;
    use crate::nbrdf::fit::generator;

    fn estimate(points: &[Vec<f64>]) -> f64 {
        intrinsic_dimension(&growth(points)).unwrap().dimension
    }

    #[test]
    fn a_swiss_roll_and_a_patch_of_a_sphere_have_two_dimensions_also_under_noise() {
        for points in [swiss_roll(1000, 0.0, 3).points, sphere_patch(1000, 3).points, swiss_roll(1000, 0.1, 4).points] {
            let found = estimate(&points);
            assert!((found - 2.0).abs() < 0.3, "{found}");
        }
    }

    #[test]
    fn below_the_scale_of_the_noise_there_are_three() {
        let growth = growth(&swiss_roll(1500, 1.5, 5).points);
        assert!(growth[0].dimension > 2.6, "{growth:?}");
    }

    #[test]
    fn a_curve_has_one_dimension_and_few_points_have_none() {
        let mut random = generator(6, 3);
        let mut helix = || 3.0 * random.random::<f64>();
        let curve: Vec<Vec<f64>> = (0..300).map(|_| helix()).map(|t| vec![t.cos(), t.sin(), t]).collect();
        assert!((estimate(&curve) - 1.0).abs() < 0.2, "{}", estimate(&curve));
        assert!(intrinsic_dimension(&growth(&curve[..10])).is_none());
    }
}
