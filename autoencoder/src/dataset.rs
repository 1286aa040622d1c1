//! Batches for training: materials, mixed and recoloured at random, and what their decoded networks are compared with.

mod change;
mod spheres;

use change::Change;
pub(crate) use spheres::Spheres;

use std::sync::Arc;

use nbrdf_core::nbrdf::corridor::Corridor;
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::nbrdf::objective::features as objective_features;
use nbrdf_core::nbrdf::samples::{SampleCounts, Samples};
use nbrdf_core::{Brdf, Rgb};
use rand::{Rng, RngExt};
use rayon::prelude::*;

use crate::loss::{Target, Wanted};
use crate::probe::Probes;
use crate::train::{TrainingData, Walk};

/// Materials per step.
pub(crate) const BATCH: usize = 32;
/// Sets of sampled directions, drawn once.
const SETS: usize = 96;

/// Walks per step between random analytic materials, whose in-between is known.
const WALKS: usize = 6;
/// Walks per step between measured materials, on which the mean colour must stay between those of the ends.
const COLOUR_WALKS: usize = 8;
/// How much an in-between material counts, against a material itself.
const WALK_WEIGHT: f32 = 1.0;
/// Weight of a distance in u′v′.
const COLOUR_WEIGHT: f32 = 1.5;
/// Sets of directions that in-between materials are known at.
const WALK_SETS: usize = 24;

/// One step's inputs and targets.
pub(crate) struct Batch {
    /// Encoder inputs, row after row: materials, then the starts of all walks, then their ends.
    pub input: Vec<f32>,
    /// How far along each walk its mixed code lies, 0..1.
    pub places: Vec<f32>,
    /// One target per material, then one per walk.
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
    walks: Vec<EvaluatedWalk>,
}

struct Evaluated {
    probes: Vec<Rgb>,
    /// One list per set.
    sets: Vec<Vec<Rgb>>,
}

struct EvaluatedWalk {
    /// Encoder inputs.
    ends: [Vec<f32>; 2],
    place: f32,
    /// Features wanted, one list for each of the first sets.
    between: Vec<Vec<f32>>,
}

impl Pool {
    /// Evaluates `measured` and `analytic` materials, and walks.
    pub fn new(data: &TrainingData, analytic_share: f32, seed: u64) -> Self {
        let sets: Vec<_> = (0..SETS as u64)
            .map(|set| Arc::new(Samples::random(&mut generator(seed, 1_000 + set), SampleCounts::STEP)))
            .collect();
        let probes = Probes::new();
        let measured_brdfs = data.measured.iter().map(|material| &material.brdf);
        let brdfs: Vec<&Arc<dyn Brdf>> = measured_brdfs.chain(data.analytic).collect();
        let log = |values: Vec<Rgb>| values.into_iter().map(|f| f.map(f32::ln_1p)).collect();
        let evaluate = |brdf: &&Arc<dyn Brdf>| Evaluated {
            probes: log(probes.probe(brdf.as_ref())),
            sets: sets.iter().map(|set| log(set.values(brdf.as_ref()))).collect(),
        };
        let materials = brdfs.par_iter().map(evaluate).collect();
        let known = |walk: &Walk| EvaluatedWalk {
            ends: walk.ends.each_ref().map(|end| probes.features(&probes.probe(end.as_ref()))),
            place: walk.t,
            between: sets[..WALK_SETS]
                .iter()
                .map(|set| objective_features(set, &set.values(walk.between.as_ref())))
                .collect(),
        };
        let walks = data.walks.par_iter().map(known).collect();
        Self { sets, probes, materials, measured: data.measured.len(), analytic_share, walks }
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
        let wanted = Wanted::Features(objective_features(&samples, &target));
        (input, Target { samples, wanted, weight: 1.0 })
    }

    /// A walk between analytic materials.
    fn walk(&self, rng: &mut impl Rng) -> Row {
        let walk = &self.walks[rng.random_range(0..self.walks.len())];
        let set = rng.random_range(0..WALK_SETS);
        let wanted = Wanted::Features(walk.between[set].clone());
        let target = Target { samples: Arc::clone(&self.sets[set]), wanted, weight: WALK_WEIGHT };
        Row { ends: walk.ends.clone(), place: walk.place, target }
    }

    /// A walk between measured materials.
    fn colour_walk(&self, rng: &mut impl Rng) -> Row {
        let ends = [(); 2].map(|()| &self.materials[rng.random_range(0..self.measured)]);
        let set = rng.random_range(0..self.sets.len());
        let linear = |values: &[Rgb]| -> Vec<Rgb> { values.iter().map(|y| y.map(f32::exp_m1)).collect() };
        let values = ends.map(|end| linear(&end.sets[set]));
        let samples = Arc::clone(&self.sets[set]);
        let wanted = Wanted::Between(Corridor::between(&samples, values.each_ref().map(Vec::as_slice)));
        let ends = ends.map(|end| self.probes.features(&linear(&end.probes)));
        Row { ends, place: rng.random_range(0.2..0.8), target: Target { samples, wanted, weight: COLOUR_WEIGHT } }
    }
}

/// A walk of a batch.
struct Row {
    ends: [Vec<f32>; 2],
    place: f32,
    target: Target,
}

impl Batches for Pool {
    fn batch(&self, seed: u64, step: usize) -> Batch {
        let walks = if self.walks.is_empty() { 0 } else { WALKS };
        let rows = BATCH + walks + COLOUR_WALKS;
        let rng = |row: usize| generator(seed, (1 << 32) + (step * rows + row) as u64);
        let materials = (0..BATCH).into_par_iter().map(|row| self.row(&mut rng(row)));
        let (mut inputs, mut targets): (Vec<_>, Vec<_>) = materials.unzip();
        let walk = |row: usize| match row < walks {
            true => self.walk(&mut rng(BATCH + row)),
            false => self.colour_walk(&mut rng(BATCH + row)),
        };
        let walked: Vec<Row> = (0..walks + COLOUR_WALKS).into_par_iter().map(walk).collect();
        let places = walked.iter().map(|row| row.place).collect();
        let mut ends = Vec::with_capacity(walked.len());
        for Row { ends: [start, end], target, .. } in walked {
            inputs.push(start);
            ends.push(end);
            targets.push(target);
        }
        inputs.extend(ends);
        Batch { input: inputs.concat(), places, targets }
    }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::Material;
    use nbrdf_core::brdf::lambert::Lambert;

    use super::*;

    fn grey(albedo: f32) -> Arc<dyn Brdf> {
        Arc::new(Lambert { albedo: Rgb::splat(albedo) })
    }

    #[test]
    fn a_batch_holds_materials_then_starts_then_ends_of_walks() {
        let measured = [0.2, 0.8].map(|albedo| Material::new("grey", grey(albedo)));
        let walks = [Walk { ends: [grey(0.1), grey(0.9)], t: 0.25, between: grey(0.3) }];
        let data = TrainingData { measured: &measured, analytic: &[], walks: &walks, networks: &[], start: None };
        let pool = Pool::new(&data, 0.0, 0);
        let Batch { input, places, targets } = pool.batch(0, 0);
        let known = BATCH + WALKS + COLOUR_WALKS;
        assert_eq!((targets.len(), places.len()), (known, WALKS + COLOUR_WALKS));
        assert!(places[..WALKS].iter().all(|&t| t == 0.25));
        let columns = input.len() / (known + places.len());
        let row = |row: usize| &input[row * columns..(row + 1) * columns];
        let features = |albedo: f32| pool.probes.features(&pool.probes.probe(grey(albedo).as_ref()));
        for walk in 0..WALKS {
            assert_eq!(row(BATCH + walk), features(0.1), "start {walk}");
            assert_eq!(row(known + walk), features(0.9), "end {walk}");
            let Wanted::Features(wanted) = &targets[BATCH + walk].wanted else { panic!("a walk with a known middle") };
            let samples = &targets[BATCH + walk].samples;
            assert_eq!(*wanted, objective_features(samples, &samples.values(grey(0.3).as_ref())));
        }
        assert!(targets[BATCH + WALKS..].iter().all(|target| matches!(target.wanted, Wanted::Between(_))));
        assert_eq!(pool.batch(0, 0).input, input, "the same step gives the same batch");
        assert_ne!(pool.batch(0, 1).input, input);
    }
}
