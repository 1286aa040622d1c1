//! The directions of a fit, drawn once: each step compares on one of the sets, picked at random.

use rand::RngExt;
use rayon::prelude::*;

use super::{FitOptions, generator};
use crate::brdf::Azimuth;
use crate::nbrdf::objective::features;
use crate::nbrdf::samples::{SampleCounts, Samples};
use crate::sample_list::SampleList;
use crate::{Brdf, Directions, Rgb};

/// Most sets drawn: half a million directions.
const SETS: usize = 1024;
/// Steps for which a set is worth drawing: that takes as long as a step.
const STEPS_PER_SET: usize = 16;

/// Sets of samples.
pub(super) struct Sets(pub Vec<Samples>);

impl Sets {
    /// Drawn in parallel, each from a stream of its own.
    pub fn new(options: &FitOptions, azimuth: Azimuth) -> Self {
        let draw = |set| {
            let rng = &mut generator(options.seed, (1 << 40) + set);
            let samples = Samples::drawn(rng, SampleCounts::STEP, options.angular);
            match azimuth {
                Azimuth::Dropped => samples,
                Azimuth::Kept => samples.turned(rng),
            }
        };
        Self((0..count(options)).into_par_iter().map(draw).collect())
    }

    /// What is to be found on every set.
    pub fn wanted(&self, target: &dyn Brdf) -> Vec<Vec<f32>> {
        self.0.iter().map(|samples| features(samples, &samples.values(target))).collect()
    }

    /// Drawn from a list, each sample as it is or with light and view exchanged, and what is to be found on them; none of
    /// an empty list.
    pub fn of_list(list: &SampleList, options: &FitOptions, azimuth: Azimuth) -> Option<(Self, Vec<Vec<f32>>)> {
        if list.is_empty() {
            return None;
        }
        let counts = SampleCounts { pixels: 0, lamps: 0, ..SampleCounts::STEP };
        let draw = |set| {
            let rng = &mut generator(options.seed, (1 << 41) + set);
            let picks: Vec<(usize, bool)> = (0..counts.log + counts.relative)
                .map(|_| (rng.random_range(0..list.len()), rng.random_range(0..2) == 1))
                .collect();
            let at: Vec<Directions> =
                picks.iter().map(|&(i, swap)| if swap { list.at[i].swapped() } else { list.at[i] }).collect();
            let factors = at.iter().map(|at| at.light.z).collect();
            let samples = Samples::new(counts, at, factors);
            let samples = match azimuth {
                Azimuth::Dropped => samples,
                Azimuth::Kept => samples.keeping_azimuth(),
            };
            let values: Vec<Rgb> = picks.iter().map(|&(i, _)| list.values[i]).collect();
            let wanted = features(&samples, &values);
            (samples, wanted)
        };
        let (sets, wanted): (Vec<_>, Vec<_>) = (0..count(options)).into_par_iter().map(draw).unzip();
        Some((Self(sets), wanted))
    }
}

fn count(options: &FitOptions) -> u64 {
    options.steps.div_ceil(STEPS_PER_SET).min(SETS) as u64
}
