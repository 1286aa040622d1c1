//! What models take to evaluate in the scene: on the pairs that the picture asks for, in its order.
//!
//! PROTOCOL "Speed" times every model on the same random directions. Here an object's own directions count, which a table
//! may find in the cache and may not, and as many of them as keep it from seeing the same few cells again.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::hint::black_box;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use crate::cost::{BATCH, median};
use crate::scene::Demand;
use crate::{Brdf, Directions, Rgb};

/// Runs whose median counts.
const REPEATS: usize = 5;
/// Batches of pairs in a run, spread over the object.
const BATCHES: usize = 8;

/// A model in its place: the object and the kind.
type Key = (usize, usize);

/// Nanoseconds per evaluation of the models so far.
#[derive(Default)]
pub(super) struct Bench {
    times: Mutex<BTreeMap<Key, f64>>,
    /// Taken over from another bench, and not measured again.
    taken: Mutex<BTreeMap<Key, f64>>,
}

impl Bench {
    /// Measures models on their objects' demands, one thread, in turns, those of before anew: only times of one run are
    /// compared.
    pub fn measure(&self, models: &[(Key, &dyn Brdf)], demands: &[Demand]) {
        let mut models: BTreeMap<Key, &dyn Brdf> = models.iter().copied().collect();
        let taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner).clone();
        models.retain(|key, _| !taken.contains_key(key));
        let mut times: Vec<Vec<f64>> = models.iter().map(|_| Vec::with_capacity(REPEATS)).collect();
        let mut out = vec![Rgb::BLACK; BATCH];
        for _ in 0..REPEATS {
            for (((object, _), brdf), times) in models.iter().zip(&mut times) {
                let batches = demands[*object].batches(BATCH, BATCHES);
                // What was evaluated before has left cold caches.
                if let Some(first) = batches.first() {
                    brdf.eval_into(black_box(first), &mut out[..first.len()]);
                }
                times.extend(run(*brdf, &batches, &mut out));
            }
        }
        let ns = times.iter_mut().map(|times| median(times));
        let mut known = self.times.lock().unwrap_or_else(PoisonError::into_inner);
        known.extend(models.keys().copied().zip(ns).filter(|(_, ns)| ns.is_finite()));
    }

    /// Of a model that was measured.
    pub fn ns(&self, key: Key) -> Option<f64> {
        let of =
            |times: &Mutex<BTreeMap<Key, f64>>| times.lock().unwrap_or_else(PoisonError::into_inner).get(&key).copied();
        of(&self.taken).or_else(|| of(&self.times))
    }

    /// Takes over what another one has measured.
    pub fn take(&self, other: &Self) {
        let others = other.times.lock().unwrap_or_else(PoisonError::into_inner).clone();
        self.taken.lock().unwrap_or_else(PoisonError::into_inner).extend(others);
    }
}

/// Nanoseconds per evaluation of one run; none where nothing is asked for.
fn run(brdf: &dyn Brdf, batches: &[Cow<[Directions]>], out: &mut [Rgb]) -> Option<f64> {
    let count: usize = batches.iter().map(|batch| batch.len()).sum();
    let start = Instant::now();
    for batch in batches {
        brdf.eval_into(black_box(batch), &mut out[..batch.len()]);
    }
    black_box(&out);
    (count > 0).then(|| start.elapsed().as_secs_f64() * 1e9 / count as f64)
}
