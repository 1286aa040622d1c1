//! Batches for training: materials, mixed and recoloured at random, and what their decoded networks are compared with.

mod spheres;

pub(crate) use spheres::Spheres;

use std::sync::Arc;

use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::nbrdf::objective::features as objective_features;
use nbrdf_core::nbrdf::samples::{SampleCounts, Samples};
use nbrdf_core::{Brdf, Material, Rgb};
use rand::{Rng, RngExt};
use rayon::prelude::*;

use crate::loss::Target;
use crate::probe::Probes;

/// Materials per step.
pub(crate) const BATCH: usize = 32;
/// Sets of sampled directions, drawn once.
const SETS: usize = 96;

/// One step's inputs and targets.
pub(crate) struct Batch {
    /// Encoder inputs, row after row.
    pub input: Vec<f32>,
    /// One target per row.
    pub targets: Vec<Target>,
}

/// Where batches come from; the same step gives the same batch.
pub(crate) trait Batches: Sync {
    fn batch(&self, seed: u64, step: usize) -> Batch;
}

/// Training materials evaluated once at all directions that training will ask for, as y = ln(1 + f).
pub(crate) struct Pool {
    sets: Vec<Arc<Samples>>,
    probes: Probes,
    materials: Vec<Evaluated>,
    /// How many of `materials` are measured; analytic ones follow.
    measured: usize,
    /// Share of a batch taken from the analytic materials.
    analytic_share: f32,
}

struct Evaluated {
    probes: Vec<Rgb>,
    /// One list per set.
    sets: Vec<Vec<Rgb>>,
}

impl Pool {
    /// Evaluates `measured` and `analytic` materials.
    pub fn new(measured: &[Material], analytic: &[Arc<dyn Brdf>], analytic_share: f32, seed: u64) -> Self {
        let sets: Vec<_> = (0..SETS as u64)
            .map(|set| Arc::new(Samples::random(&mut generator(seed, 1_000 + set), SampleCounts::STEP)))
            .collect();
        let probes = Probes::new();
        let measured_brdfs = measured.iter().map(|material| &material.brdf);
        let brdfs: Vec<&Arc<dyn Brdf>> = measured_brdfs.chain(analytic).collect();
        let log = |values: Vec<Rgb>| values.into_iter().map(|f| f.map(f32::ln_1p)).collect();
        let evaluate = |brdf: &&Arc<dyn Brdf>| Evaluated {
            probes: log(probes.probe(brdf.as_ref())),
            sets: sets.iter().map(|set| log(set.values(brdf.as_ref()))).collect(),
        };
        let materials = brdfs.par_iter().map(evaluate).collect();
        Self { sets, probes, materials, measured: measured.len(), analytic_share }
    }

    fn row(&self, rng: &mut impl Rng) -> (Vec<f32>, Target) {
        let analytic = self.materials.len() - self.measured;
        let from_analytic = analytic > 0 && rng.random_range(0.0..1.0) < self.analytic_share;
        let pick = |rng: &mut dyn Rng| match from_analytic {
            true => self.measured + rng.random_range(0..analytic),
            false => rng.random_range(0..self.measured),
        };
        let (a, b) = (&self.materials[pick(rng)], &self.materials[pick(rng)]);
        let set = rng.random_range(0..self.sets.len());
        let change = Change::random(rng);
        let target = change.apply(&a.sets[set], &b.sets[set]);
        let samples = Arc::clone(&self.sets[set]);
        let input = self.probes.features(&change.apply(&a.probes, &b.probes));
        let wanted = objective_features(&samples, &target);
        (input, Target { samples, features: wanted })
    }
}

impl Batches for Pool {
    fn batch(&self, seed: u64, step: usize) -> Batch {
        let row = |row: usize| self.row(&mut generator(seed, (1 << 32) + (step * BATCH + row) as u64));
        let (inputs, targets): (Vec<_>, Vec<_>) = (0..BATCH).into_par_iter().map(row).unzip();
        Batch { input: inputs.concat(), targets }
    }
}

/// A random change that keeps a material a material: a blend with another one, mixed and scaled channels.
struct Change {
    blend: f32,
    /// Rows: how much of each old channel a new channel takes.
    channels: [[f32; 3]; 3],
    scale: [f32; 3],
}

impl Change {
    fn random(rng: &mut impl Rng) -> Self {
        let blend = if rng.random_range(0.0..1.0) < 0.5 { rng.random_range(0.0..1.0f32) } else { 0.0 };
        let mut channels = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if rng.random_range(0.0..1.0) < 0.3 {
            let keep: f32 = rng.random_range(0.0..1.0);
            for (own, row) in channels.iter_mut().enumerate() {
                let other: [f32; 3] = std::array::from_fn(|_| rng.random_range(0.01..1.0f32));
                let sum: f32 = other.iter().sum();
                *row = std::array::from_fn(|c| keep * f32::from(u8::from(c == own)) + (1.0 - keep) * other[c] / sum);
            }
        }
        let mut scale = [1.0; 3];
        if rng.random_range(0.0..1.0) < 0.5 {
            let common: f32 = rng.random_range(-0.5..0.3);
            scale = std::array::from_fn(|_| (common + rng.random_range(-0.4..0.4f32)).exp());
        }
        Self { blend, channels, scale }
    }

    /// From y = ln(1 + f) of two materials to f of the changed one.
    fn apply(&self, a: &[Rgb], b: &[Rgb]) -> Vec<Rgb> {
        let one = |(a, b): (&Rgb, &Rgb)| {
            let y = a.zip(*b, |a, b| a + self.blend * (b - a));
            let channel = |c: usize| {
                let [r, g, b] = self.channels[c];
                self.scale[c] * (r * y[0] + g * y[1] + b * y[2]).exp_m1()
            };
            Rgb(std::array::from_fn(channel))
        };
        a.iter().zip(b).map(one).collect()
    }
}
