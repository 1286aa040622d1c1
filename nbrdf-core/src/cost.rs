//! What evaluation costs: nanoseconds, beside the loop that everybody would write first.
//!
//! PROTOCOL "Speed": one thread, batches of 4096 random valid directions, conversion to the model's own coordinates
//! included, median of at least 30 repeats. All models and the reference loop take turns in one run, so that a busy
//! machine slows all of them alike: the ratio means more than the nanoseconds.

mod fixed_arrays;
mod peak;
mod reference_loop;
mod with_set;

use std::hint::black_box;
use std::time::Instant;

use serde::Serialize;

pub use fixed_arrays::FixedArrays;
pub use peak::peak_fma;
pub use reference_loop::ReferenceLoop;
pub use with_set::WithSet;

use crate::brdf::Prepared;
use crate::nbrdf::fit::{generator, random_network};
use crate::nbrdf::samples::random_directions;
use crate::{Brdf, Directions, Rgb};

/// Directions per batch.
pub const BATCH: usize = 4096;
/// Repeats whose median is reported.
pub const REPEATS: usize = 31;
/// Floating point operations of a whole published network: a multiplication and an addition per weight.
pub const NETWORK_FLOP: f64 = 1350.0;
/// Runs of a turn that are counted.
const IN_A_ROW: usize = 8;

/// What a model is given to evaluate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Given {
    /// Pairs (ω_i, ω_o).
    Directions,
    /// Pairs whose half and difference vectors are known.
    Prepared,
}

/// Cost of one evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cost {
    /// Nanoseconds per evaluation, three channels together.
    pub ns: f64,
    /// How many times the reference loop of the same run takes as long.
    pub ratio_to_reference_loop: f64,
}

/// The same directions for everybody.
pub struct Track {
    at: Prepared,
}

impl Track {
    /// [`BATCH`] pairs above the surface, uniform in (θ_half, θ_diff, φ_diff).
    pub fn new(seed: u64) -> Self {
        let mut rng = generator(seed, 11);
        let pairs = std::iter::repeat_with(|| random_directions(&mut rng)).filter(|at| at.is_above());
        Self { at: Prepared::new(pairs.take(BATCH).collect()) }
    }

    /// The pairs.
    pub fn directions(&self) -> &[Directions] {
        self.at.directions()
    }

    /// The pairs, prepared.
    pub const fn prepared(&self) -> &Prepared {
        &self.at
    }

    /// One batch \[s\].
    pub fn run(&self, brdf: &dyn Brdf, given: Given, out: &mut [Rgb]) -> f64 {
        let start = Instant::now();
        match given {
            Given::Directions => brdf.eval_into(black_box(self.at.directions()), out),
            Given::Prepared => brdf.eval_prepared(black_box(&self.at), out),
        }
        black_box(&out);
        start.elapsed().as_secs_f64()
    }

    /// The cost of every model, beside the reference loop: medians of `repeats` runs each, in turns, so that all meet
    /// the same weather. A turn is some runs in a row, the first of which is not counted: the models before it, tables
    /// above all, leave cold caches.
    pub fn measure(&self, models: &[(&dyn Brdf, Given)], repeats: usize) -> Vec<Cost> {
        let reference = ReferenceLoop::new(&random_network(0, 0));
        let mut out = vec![Rgb::BLACK; BATCH];
        let mut times = vec![Vec::with_capacity(repeats); models.len() + 1];
        for _ in 0..repeats.div_ceil(IN_A_ROW) {
            let all = std::iter::once((&reference as &dyn Brdf, Given::Directions)).chain(models.iter().copied());
            for ((brdf, given), times) in all.zip(&mut times) {
                self.run(brdf, given, &mut out);
                times.extend((0..IN_A_ROW).map(|_| self.run(brdf, given, &mut out)));
            }
        }
        let ns: Vec<f64> = times.iter_mut().map(|times| median(times) * 1e9 / BATCH as f64).collect();
        ns[1..].iter().map(|&own| Cost { ns: own, ratio_to_reference_loop: ns[0] / own }).collect()
    }
}

/// Median seconds of a piece of work; one run before is not counted.
pub fn seconds(repeats: usize, mut work: impl FnMut()) -> f64 {
    work();
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    median(&mut (0..repeats).map(time).collect::<Vec<_>>())
}

/// The middle one; the mean of the two middle ones where there are two.
pub(crate) fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => f64::NAN,
        n if n % 2 == 1 => values[middle],
        _ => 0.5 * (values[middle - 1] + values[middle]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::lambert::Lambert;

    #[test]
    fn a_batch_is_valid_directions_and_the_same_each_time() {
        let track = Track::new(3);
        assert_eq!(track.directions().len(), BATCH);
        assert!(track.directions().iter().all(|at| at.is_above()));
        assert_eq!(track.directions(), Track::new(3).directions());
    }

    #[test]
    fn every_model_gets_a_cost() {
        let reference = ReferenceLoop::new(&random_network(0, 0));
        let grey = Lambert { albedo: Rgb::splat(0.5) };
        let models: [(&dyn Brdf, Given); 2] = [(&reference, Given::Directions), (&grey, Given::Prepared)];
        let costs = Track::new(0).measure(&models, 2);
        assert_eq!(costs.len(), 2);
        assert!(costs.iter().all(|cost| cost.ns > 0.0 && cost.ratio_to_reference_loop > 0.0));
    }

    #[test]
    fn the_median_does_not_mind_one_interruption() {
        assert_eq!(median(&mut [1.0, 100.0, 2.0]), 2.0);
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 100.0]), 3.0);
        assert!(median(&mut []).is_nan());
    }
}
