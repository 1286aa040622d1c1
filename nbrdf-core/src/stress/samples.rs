//! Lists of measured samples: few, noisy, of a sample that leans.

use super::damage::{ADDED, LITTLE, MUCH, even, tilted};
use super::hazard::{Group, Hazard};
use crate::nbrdf::fit::generator;
use crate::nbrdf::samples::random_directions;
use crate::sample_list::SampleList;
use crate::sampling::evaluate;
use crate::{Brdf, Directions, Rgb};

/// A hazard, and how samples are taken under it.
pub struct Sampled {
    /// The hazard.
    pub hazard: Hazard,
    /// How many samples.
    pub count: usize,
    /// Standard deviation of a sample's logarithm.
    noise: f32,
    /// How far the sample leans \[degrees\].
    tilt: f32,
}

/// All of them.
pub const LISTS: [Sampled; 5] = [
    sampled("samples_800", "800 random samples", 800, 0.0, 0.0),
    sampled("samples_200", "200 random samples", 200, 0.0, 0.0),
    sampled("samples_50", "50 random samples", 50, 0.0, 0.0),
    sampled("samples_noisy", "800 samples off by 10 % (standard deviation)", 800, 0.1, 0.0),
    sampled("samples_misaligned", "800 samples of a surface that leans by 1°", 800, 0.0, 1.0),
];

const fn sampled(name: &'static str, title: &'static str, count: usize, noise: f32, tilt: f32) -> Sampled {
    let hazard = Hazard { name, group: Group::Data, title, measure: ADDED, holds: LITTLE, fails: MUCH };
    Sampled { hazard, count, noise, tilt }
}

impl Sampled {
    /// Samples of a material, uniform in θ_half, θ_diff, φ_diff.
    pub fn of(&self, brdf: &dyn Brdf, seed: u64) -> SampleList {
        let rng = &mut generator(seed, 10);
        let drawn = std::iter::repeat_with(|| random_directions(rng));
        let at: Vec<Directions> = drawn.filter(|at| at.is_above()).take(self.count).collect();
        SampleList { values: self.values(brdf, &at, seed), at, below: 0 }
    }

    /// f_r \[1/sr\] as it is measured at given pairs.
    pub fn values(&self, brdf: &dyn Brdf, at: &[Directions], seed: u64) -> Vec<Rgb> {
        let rng = &mut generator(seed, 11);
        // What leans below the horizon is measured as black, as by any instrument.
        let seen: Vec<Directions> = at.iter().map(|&at| tilted(at, self.tilt.to_radians())).collect();
        evaluate(brdf, &seen).into_iter().map(|f| f * even(rng, self.noise)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::lambert::Lambert;

    #[test]
    fn lists_are_as_long_as_they_say_and_noise_is_as_large() {
        let grey = Lambert { albedo: Rgb::splat(0.5) };
        for list in &LISTS {
            let samples = list.of(&grey, 1);
            assert_eq!(samples.len(), list.count);
            let logs = samples.values.iter().map(|f| (f[0] * std::f32::consts::PI / 0.5).ln().powi(2));
            let deviation = (logs.sum::<f32>() / list.count as f32).sqrt();
            assert!((deviation - list.noise).abs() < 0.02, "{}: {deviation}", list.hazard.name);
        }
    }
}
