//! Fits networks to reflectances: from a random start, or many from one shared start.
//!
//! Differs from Sztrajman et al. (2021), section 3.2: the loss has a relative and a displayed term beside the log term
//! (module [`objective`](super::objective)), and a shared start with a pull towards it keeps the networks of a library
//! comparable weight by weight.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::gradient::Backpropagation;
use super::objective::{Objective, features, features_into, pull_back};
use super::samples::{SampleCounts, Samples};
use super::{Layout, Nbrdf, PUBLISHED_HIDDEN, weight_count};
use crate::adam::Adam;
use crate::{Brdf, Rgb};

/// How long and how carefully to fit.
#[derive(Clone, Copy, Debug)]
pub struct FitOptions {
    /// Gradient steps.
    pub steps: usize,
    /// Largest learning rate; it falls to zero along a cosine.
    pub rate: f32,
    /// Weight of ½‖w − start‖².
    pub proximity: f32,
    /// Seed of the sampled directions.
    pub seed: u64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self { steps: 4000, rate: 3e-3, proximity: 0.0, seed: 0 }
    }
}

impl FitOptions {
    /// For many networks from one shared start.
    pub fn shared_start(seed: u64) -> Self {
        Self { proximity: 1e-5, seed, ..Self::default() }
    }
}

/// Random weights after Glorot and Bengio (2010): uniform within √(6 / (rows + columns)), biases zero.
pub fn random_start(rng: &mut impl Rng, hidden: [usize; 2]) -> Vec<f32> {
    let mut weights = vec![0.0; weight_count(hidden)];
    let rows = [super::INPUTS, hidden[0], hidden[1]];
    for ((kernel, bias), rows) in Layout::new(hidden).layers.into_iter().zip(rows) {
        let limit = (6.0 / (rows + bias.len()) as f32).sqrt();
        weights[kernel].fill_with(|| rng.random_range(-limit..limit));
    }
    weights
}

/// The random generator for one purpose within a seeded command.
pub fn generator(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(stream);
    rng
}

/// Fits one network, starting at `start`.
///
/// `cancelled` is asked now and then; a cancelled fit returns `None`.
pub fn fit(start: &Nbrdf, target: &dyn Brdf, options: FitOptions, cancelled: &dyn Fn() -> bool) -> Option<Nbrdf> {
    let mut weights = start.weights().to_vec();
    let mut gradient = vec![0.0; weights.len()];
    let mut adam = Adam::new(weights.len());
    let mut network = Backpropagation::new(start.hidden());
    let mut rng = generator(options.seed, 1);
    let mut values = Vec::new();
    let (mut own, mut by_feature, mut by_value) = (Vec::new(), Vec::new(), Vec::new());
    for step in 0..options.steps {
        if step % 64 == 0 && cancelled() {
            return None;
        }
        let samples = Samples::random(&mut rng, SampleCounts::STEP);
        let wanted = features(&samples, &samples.values(target));
        values.resize(samples.at.len(), Rgb::BLACK);
        by_value.resize(values.len(), Rgb::BLACK);
        own.resize(wanted.len(), 0.0);
        by_feature.resize(wanted.len(), 0.0);
        network.forward(&weights, &samples.at, &mut values);
        features_into(&samples, &values, &mut own);
        Objective::FIT.loss(&samples, &own, &wanted, &mut by_feature);
        pull_back(&samples, &values, &own, &by_feature, &mut by_value);
        network.backward(&weights, &samples.at, &by_value, &mut gradient);
        for ((g, w), s) in gradient.iter_mut().zip(&weights).zip(start.weights()) {
            *g += options.proximity * (w - s);
        }
        adam.step(cosine(options.rate, step, options.steps), &gradient, &mut weights);
    }
    Nbrdf::new(start.hidden(), weights).ok()
}

/// Fits every target from its own start, in parallel; `done` is called after each. Same bits for any thread count.
pub fn fit_all(
    jobs: &[(Nbrdf, &dyn Brdf)],
    options: FitOptions,
    done: &(dyn Fn() + Sync),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Nbrdf>> {
    let one = |(start, target): &(Nbrdf, &dyn Brdf)| {
        let fitted = fit(start, *target, options, cancelled);
        done();
        fitted
    };
    jobs.par_iter().map(one).collect()
}

/// A network of the published shape with random weights.
pub fn random_network(seed: u64, stream: u64) -> Nbrdf {
    Nbrdf::of_valid(PUBLISHED_HIDDEN, random_start(&mut generator(seed, stream), PUBLISHED_HIDDEN))
}

/// Learning rate that falls from `rate` to zero along half a cosine.
pub fn cosine(rate: f32, step: usize, steps: usize) -> f32 {
    0.5 * rate * (1.0 + (std::f32::consts::PI * step as f32 / steps as f32).cos())
}
