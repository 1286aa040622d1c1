//! One evaluation: networks with every kind of vectors, loops, formulas, tables, candle.

use candle_core::{Device, Tensor};
use criterion::{Criterion, Throughput};
use nbrdf_core::brdf::Prepared;
use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::brdf::lambert::Lambert;
use nbrdf_core::brdf::table::{Lookup, Table};
use nbrdf_core::cost::{BATCH, FixedArrays, Given, ReferenceLoop, Track, WithSet};
use nbrdf_core::library::builtin;
use nbrdf_core::sampling::evaluate;
use nbrdf_core::simd::InstructionSet;
use nbrdf_core::{Brdf, Directions, HalfDiff, Nbrdf, Rgb};

/// A material of ordinary gloss.
pub fn network() -> Nbrdf {
    builtin::shared().get("gold-paint").expect("a built-in material").network.clone()
}

/// The network as three matrix products in candle.
struct Candle {
    layers: Vec<(Tensor, Tensor)>,
}

impl Candle {
    fn new(network: &Nbrdf) -> candle_core::Result<Self> {
        let weights = network.weights();
        let layer = |(kernel, bias): (std::ops::Range<usize>, std::ops::Range<usize>)| {
            let shape = (kernel.len() / bias.len(), bias.len());
            let kernel = Tensor::from_slice(&weights[kernel], shape, &Device::Cpu)?;
            Ok((kernel, Tensor::from_slice(&weights[bias.clone()], bias.len(), &Device::Cpu)?))
        };
        Ok(Self { layers: network.layout().layers.into_iter().map(layer).collect::<candle_core::Result<_>>()? })
    }

    fn forward(&self, at: &[Directions]) -> candle_core::Result<Vec<f32>> {
        let input = |at: &Directions| {
            let HalfDiff { half, diff } = at.half_diff();
            [half.to_array(), diff.to_array()].concat()
        };
        let mut x = Tensor::from_vec(at.iter().flat_map(input).collect(), (at.len(), 6), &Device::Cpu)?;
        for (index, (kernel, bias)) in self.layers.iter().enumerate() {
            x = x.matmul(kernel)?.broadcast_add(bias)?;
            x = if index < 2 { x.relu()? } else { (x.exp()? - 1.0)?.relu()? };
        }
        x.flatten_all()?.to_vec1()
    }
}

impl Brdf for Candle {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_into(&[at], &mut out);
        out[0]
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        let values = self.forward(at).expect("tensors of the right shape");
        Rgb::flat_mut(out).copy_from_slice(&values);
    }
}

fn models(network: &Nbrdf) -> Vec<(String, Box<dyn Brdf>)> {
    let mut models: Vec<(String, Box<dyn Brdf>)> = vec![
        ("reference_loop".to_owned(), Box::new(ReferenceLoop::new(network))),
        ("fixed_arrays".to_owned(), Box::new(FixedArrays::new(network).expect("a network of the published shape"))),
        ("candle_matmul".to_owned(), Box::new(Candle::new(network).expect("a network as tensors"))),
    ];
    for set in InstructionSet::available() {
        models.push((format!("nbrdf_{}", set.name()), Box::new(WithSet { network: network.clone(), set })));
    }
    let grey = Rgb::splat(0.2);
    let nearest = Table::tabulate(network, Lookup::Nearest);
    let trilinear = nearest.clone().with_lookup(Lookup::Trilinear);
    models.push(("nbrdf_pruned".to_owned(), Box::new(network.pruned())));
    models.push(("lambert".to_owned(), Box::new(Lambert { albedo: grey })));
    models.push(("ggx".to_owned(), Box::new(Ggx { diffuse: grey, f0: Rgb::splat(0.04), alpha: 0.2 })));
    models.push(("table_nearest".to_owned(), Box::new(nearest)));
    models.push(("table_trilinear".to_owned(), Box::new(trilinear)));
    models
}

/// A batch of pairs (ω_i, ω_o), conversion included.
pub fn from_directions(criterion: &mut Criterion) {
    run(criterion, "evaluate from directions", Given::Directions, models(&network()));
}

/// A batch of pairs whose half and difference vectors are known.
pub fn network_alone(criterion: &mut Criterion) {
    let network = network();
    let models = models(&network).into_iter().filter(|(name, _)| name.starts_with("nbrdf"));
    run(criterion, "evaluate the network alone", Given::Prepared, models.collect());
}

fn run(criterion: &mut Criterion, title: &str, given: Given, models: Vec<(String, Box<dyn Brdf>)>) {
    let track = Track::new(0);
    let mut out = vec![Rgb::BLACK; BATCH];
    let mut group = criterion.benchmark_group(title);
    group.throughput(Throughput::Elements(BATCH as u64));
    for (name, brdf) in models {
        group.bench_function(name, |bencher| bencher.iter(|| track.run(brdf.as_ref(), given, &mut out)));
    }
}

/// Sixteen batches on one thread and on two.
pub fn threads(criterion: &mut Criterion) {
    let network = network();
    let at = Prepared::new(Track::new(0).directions().iter().cycle().take(16 * BATCH).copied().collect());
    let mut group = criterion.benchmark_group("evaluate on several threads");
    group.throughput(Throughput::Elements(at.len() as u64));
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        group.bench_function(threads.to_string(), |bencher| {
            pool.install(|| bencher.iter(|| evaluate(&network, at.directions())));
        });
    }
}
