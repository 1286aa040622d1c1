//! Steps of fitting a network and of training the autoencoder, ours beside plain candle.

use autoencoder::{Architecture, TrainOptions, Trainer, TrainingData};
use criterion::{Criterion, Throughput};
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::fit::{FitOptions, fit, random_network};
use nbrdf_core::{Database, Material, Nbrdf, Split};

use crate::evaluation::network;
use crate::plain_candle::PlainCandle;

/// A thousand steps of one fit on one thread, the sampled directions included.
pub fn fits(criterion: &mut Criterion) {
    const STEPS: usize = 1000;
    let (target, start) = (network(), random_network(0, 0));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut group = criterion.benchmark_group("fit");
    group.sample_size(10).throughput(Throughput::Elements(STEPS as u64));
    let options = FitOptions { steps: STEPS, ..FitOptions::default() };
    group.bench_function("steps of 512 directions", |bencher| {
        one.install(|| bencher.iter(|| fit(&start, &target, options, &|| false)));
    });
}

/// One training step of 32 materials × 512 directions. Ours also walks between eight pairs of them (16 more encodings,
/// 8 more decodings): the ratio understates.
pub fn steps(criterion: &mut Criterion) {
    let library = builtin::shared();
    let learns = |m: &Material| Database::of(&m.name) == Database::Merl && Split::of(&m.name).is_training();
    let measured: Vec<Material> = library.materials().into_iter().filter(learns).collect();
    let networks: Vec<Nbrdf> = measured.iter().filter_map(|material| material.network.clone()).collect();
    let data = TrainingData {
        measured: &measured,
        analytic: &[],
        walks: &[],
        networks: &networks,
        start: library.shared_start(),
    };
    let options = TrainOptions { analytic_share: 0.0, ..TrainOptions::new(Architecture::Znbrdf) };
    let mut trainer = Trainer::new(&data, &options).expect("enough to learn from");
    let mut plain = PlainCandle::new(&measured).expect("a model");
    let mut group = criterion.benchmark_group("training step");
    group.sample_size(20);
    group.bench_function("znbrdf", |bencher| bencher.iter(|| trainer.step().expect("a step")));
    group.bench_function("znbrdf in plain candle", |bencher| bencher.iter(|| plain.step().expect("a step")));
}
