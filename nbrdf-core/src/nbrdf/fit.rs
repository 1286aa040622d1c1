//! Fits networks to reflectances: from a random start, or many from one shared start.
//!
//! Differs from Sztrajman et al. (2021), section 3.2: the loss has a relative and a displayed term beside the log term
//! (module [`objective`](super::objective)), and a shared start with a pull towards it keeps the networks of a library
//! comparable weight by weight.

mod sets;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::anisotropic::AnisotropicNbrdf;
use super::gradient::Backpropagation;
use super::objective::{Objective, features_into, pull_back};
use super::samples::{Angular, Samples};
use super::{Layout, Nbrdf, PUBLISHED_HIDDEN, weight_count};
use crate::adam::{Adam, Pace};
use crate::brdf::Azimuth;
use crate::sample_list::SampleList;
use crate::{Brdf, Rgb};
use sets::Sets;

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
    /// How directions are drawn.
    pub angular: Angular,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self { steps: 4000, rate: 3e-3, proximity: 0.0, seed: 0, angular: Angular::HalfDifference }
    }
}

impl FitOptions {
    /// For many networks from one shared start.
    pub fn shared_start(seed: u64) -> Self {
        Self { proximity: 1e-5, seed, ..Self::default() }
    }
}

/// Random weights after Glorot and Bengio (2010): uniform within √(6 / (rows + columns)), biases zero.
pub(crate) fn random_start(rng: &mut impl Rng, hidden: [usize; 2]) -> Vec<f32> {
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
/// `cancelled` is asked now and then; a cancelled fit returns `None`, and so does one that diverges.
pub fn fit(start: &Nbrdf, target: &dyn Brdf, options: FitOptions, cancelled: &dyn Fn() -> bool) -> Option<Nbrdf> {
    fit_reading(Azimuth::Dropped, start, target, options, cancelled)
}

/// As [`fit`], for a material that changes when it is turned; the start may be one that has not read the azimuth.
pub fn fit_anisotropic(
    start: &Nbrdf,
    target: &dyn Brdf,
    options: FitOptions,
    cancelled: &dyn Fn() -> bool,
) -> Option<AnisotropicNbrdf> {
    fit_reading(Azimuth::Kept, start, target, options, cancelled).map(AnisotropicNbrdf::of)
}

fn fit_reading(
    azimuth: Azimuth,
    start: &Nbrdf,
    target: &dyn Brdf,
    options: FitOptions,
    cancelled: &dyn Fn() -> bool,
) -> Option<Nbrdf> {
    let sets = Sets::new(&options, azimuth);
    fit_on(&sets, &sets.wanted(target), start, options, cancelled)
}

/// As [`fit`], to samples in a list; each counts as it is and with light and view exchanged, by reciprocity.
///
/// `None` also if the list is empty.
pub fn fit_list(start: &Nbrdf, list: &SampleList, options: FitOptions, cancelled: &dyn Fn() -> bool) -> Option<Nbrdf> {
    fit_list_reading(Azimuth::Dropped, start, list, options, cancelled)
}

/// As [`fit_list`], for a material that changes when it is turned.
pub fn fit_list_anisotropic(
    start: &Nbrdf,
    list: &SampleList,
    options: FitOptions,
    cancelled: &dyn Fn() -> bool,
) -> Option<AnisotropicNbrdf> {
    fit_list_reading(Azimuth::Kept, start, list, options, cancelled).map(AnisotropicNbrdf::of)
}

fn fit_list_reading(
    azimuth: Azimuth,
    start: &Nbrdf,
    list: &SampleList,
    options: FitOptions,
    cancelled: &dyn Fn() -> bool,
) -> Option<Nbrdf> {
    let (sets, wanted) = Sets::of_list(list, &options, azimuth)?;
    fit_on(&sets, &wanted, start, options, cancelled)
}

fn fit_on(
    sets: &Sets,
    wanted: &[Vec<f32>],
    start: &Nbrdf,
    options: FitOptions,
    cancelled: &dyn Fn() -> bool,
) -> Option<Nbrdf> {
    let mut rng = generator(options.seed, 1);
    let mut step = Step::new(start);
    for index in 0..options.steps {
        if index % 64 == 0 && cancelled() {
            return None;
        }
        let set = rng.random_range(0..sets.0.len());
        step.gradient(&sets.0[set], &wanted[set]);
        for ((g, w), s) in step.gradient.iter_mut().zip(&step.weights).zip(start.weights()) {
            *g += options.proximity * (w - s);
        }
        let pace = Pace::plain(index + 1, f64::from(cosine(options.rate, index, options.steps)));
        step.adam.step(&pace, &step.gradient, &mut step.weights);
    }
    Nbrdf::new(start.hidden(), step.weights).ok()
}

/// What one step needs, used again by the next.
struct Step {
    weights: Vec<f32>,
    gradient: Vec<f32>,
    adam: Adam,
    network: Backpropagation,
    values: Vec<Rgb>,
    by_value: Vec<Rgb>,
    own: Vec<f32>,
    by_feature: Vec<f32>,
}

impl Step {
    fn new(start: &Nbrdf) -> Self {
        let count = start.weights().len();
        Self {
            weights: start.weights().to_vec(),
            gradient: vec![0.0; count],
            adam: Adam::new(count),
            network: Backpropagation::new(start.hidden()),
            values: Vec::new(),
            by_value: Vec::new(),
            own: Vec::new(),
            by_feature: Vec::new(),
        }
    }

    /// Of the loss on these samples.
    fn gradient(&mut self, samples: &Samples, wanted: &[f32]) {
        self.values.resize(samples.at.len(), Rgb::BLACK);
        self.by_value.resize(samples.at.len(), Rgb::BLACK);
        self.own.resize(wanted.len(), 0.0);
        self.by_feature.resize(wanted.len(), 0.0);
        self.network.forward(&self.weights, &samples.at, &mut self.values);
        features_into(samples, &self.values, &mut self.own);
        Objective::FIT.loss(samples, &self.own, wanted, &mut self.by_feature);
        pull_back(samples, &self.values, &self.own, &self.by_feature, &mut self.by_value);
        self.network.backward(&self.weights, &samples.at, &self.by_value, &mut self.gradient);
    }
}

/// Fits every target from its own start, in parallel and on the same directions; `done` is called after each. Same bits
/// for any thread count.
pub fn fit_all(
    jobs: &[(Nbrdf, &dyn Brdf)],
    options: FitOptions,
    done: &(dyn Fn() + Sync),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Nbrdf>> {
    let sets = Sets::new(&options, Azimuth::Dropped);
    let one = |(start, target): &(Nbrdf, &dyn Brdf)| {
        let fitted = fit_on(&sets, &sets.wanted(*target), start, options, cancelled);
        done();
        fitted
    };
    jobs.par_iter().map(one).collect()
}

/// A network of the published shape with random weights.
pub fn random_network(seed: u64, stream: u64) -> Nbrdf {
    random_hidden(seed, stream, PUBLISHED_HIDDEN)
}

/// A network of any widths with random weights.
pub fn random_hidden(seed: u64, stream: u64, hidden: [usize; 2]) -> Nbrdf {
    Nbrdf::of_valid(hidden, random_start(&mut generator(seed, stream), hidden))
}

/// Learning rate that falls from `rate` to zero along half a cosine.
pub fn cosine(rate: f32, step: usize, steps: usize) -> f32 {
    0.5 * rate * (1.0 + (std::f32::consts::PI * step as f32 / steps as f32).cos())
}

#[cfg(test)]
mod tests;
