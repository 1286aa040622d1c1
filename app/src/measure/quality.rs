//! Representations over some materials, side by side: encoded, decoded, compared and timed.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use anyhow::Result;
use autoencoder::Autoencoder;
use nbrdf_core::cost::{Given, Track};
use nbrdf_core::{Brdf, Code, Material, Representation};
use rayon::prelude::*;

use super::times::Times;
use super::{Target, Trust};
use crate::progress;

/// Longer codes are not kept: a table's is 50 MB of text.
const LONGEST_KEPT: usize = 512;

/// Encoding that takes less \[s\] is timed when it is done again.
const SHORT: f64 = 0.01;

/// A representation that is to be measured.
pub struct Candidate {
    /// The representation.
    pub representation: Arc<dyn Representation>,
    /// Tells which error to expect.
    pub known: Arc<Autoencoder>,
}

/// A material, and what became of it.
pub struct Encoded {
    /// Its name.
    pub name: String,
    /// Its code, unless that is long.
    pub code: Option<Vec<f32>>,
    /// Bytes that are kept of it.
    pub bytes: usize,
    /// Every metric, `encode_s`, `expected_log_error`, and `distance` where codes have one.
    pub figures: BTreeMap<String, f64>,
    /// What it took.
    pub times: Times,
}

/// What a representation costs, and how close it comes.
pub struct Quality {
    /// Numbers in a code.
    pub dim: usize,
    /// The mark that codes carry.
    pub checkpoint: String,
    /// Bytes of one material: the median.
    pub bytes: usize,
    /// Bytes that all share.
    pub shared_bytes: usize,
    /// What it took: the median over materials; none of no materials.
    pub times: Option<Times>,
    /// One by one.
    pub materials: Vec<Encoded>,
}

impl Quality {
    fn of(representation: &dyn Representation, materials: Vec<Encoded>) -> Self {
        let mut bytes: Vec<usize> = materials.iter().map(|material| material.bytes).collect();
        bytes.sort_unstable();
        Self {
            dim: representation.dim(),
            checkpoint: representation.checkpoint().to_owned(),
            bytes: bytes.get(bytes.len() / 2).copied().unwrap_or_default(),
            shared_bytes: representation.shared_bytes(),
            times: Times::median(&materials.iter().map(|material| material.times).collect::<Vec<_>>()),
            materials,
        }
    }
}

/// One material in one representation.
struct Stored {
    code: Code,
    encode_s: f64,
    decoded: Box<dyn Brdf>,
}

/// Materials, what they are compared with, and how they are timed.
pub struct Bench<'a> {
    materials: Vec<&'a Material>,
    targets: Vec<Target>,
    track: Track,
    repeats: usize,
}

impl<'a> Bench<'a> {
    /// Renders the materials once; evaluation is timed by the median of so many `repeats`.
    pub fn new(materials: Vec<&'a Material>, seed: u64, repeats: usize) -> Self {
        let targets = materials.par_iter().map(|material| Target::new(material.brdf.as_ref())).collect();
        Self { materials, targets, track: Track::new(seed), repeats }
    }

    /// How many materials.
    pub fn count(&self) -> usize {
        self.materials.len()
    }

    /// Measures representations, material by material: all of them are timed in turns, so that a busy machine slows all
    /// alike, and only one material's tables are held at a time. `done` is called after every encoding.
    pub fn measure(&self, candidates: &[Candidate], done: &dyn Fn()) -> Result<Vec<Quality>> {
        let mut encoded: Vec<Vec<Encoded>> = candidates.iter().map(|_| Vec::new()).collect();
        for (material, target) in self.materials.iter().zip(&self.targets) {
            let stored = store(candidates, material, done)?;
            let times = self.time(&stored);
            let all = candidates.par_iter().zip(stored).zip(times);
            let all = all.map(|((candidate, stored), times)| candidate.compare(material, target, stored, times));
            for (encoded, own) in encoded.iter_mut().zip(all.collect::<Result<Vec<_>>>()?) {
                encoded.push(own);
            }
        }
        let all = candidates.iter().zip(encoded);
        Ok(all.map(|(candidate, encoded)| Quality::of(candidate.representation.as_ref(), encoded)).collect())
    }

    /// The times of another run, without the errors, which are the same each time.
    pub fn times(&self, candidates: &[Candidate], done: &dyn Fn()) -> Result<Vec<Option<Times>>> {
        let mut times: Vec<Vec<Times>> = candidates.iter().map(|_| Vec::new()).collect();
        for material in &self.materials {
            for (times, own) in times.iter_mut().zip(self.time(&store(candidates, material, done)?)) {
                times.push(own);
            }
        }
        Ok(times.iter().map(|times| Times::median(times)).collect())
    }

    fn time(&self, stored: &[Stored]) -> Vec<Times> {
        let asked: Vec<_> = stored.iter().map(|own| (own.decoded.as_ref(), Given::Directions)).collect();
        let costs = self.track.measure(&asked, self.repeats);
        costs.into_iter().zip(stored).map(|(cost, own)| Times::of(cost, own.encode_s)).collect()
    }
}

/// One material in all representations, one after the other: side by side, their times would tell of each other.
fn store(candidates: &[Candidate], material: &Material, done: &dyn Fn()) -> Result<Vec<Stored>> {
    let timed = |representation: &dyn Representation| -> Result<(Code, f64)> {
        let start = Instant::now();
        let code = representation.encode(material)?;
        Ok((code, start.elapsed().as_secs_f64()))
    };
    let one = |Candidate { representation, .. }: &Candidate| {
        progress::check()?;
        let first = timed(representation)?;
        // The representations before it left cold caches, which only short times notice.
        let (code, encode_s) = if first.1 < SHORT { timed(representation)? } else { first };
        done();
        Ok(Stored { decoded: representation.decode(&code)?, code, encode_s })
    };
    candidates.iter().map(one).collect()
}

impl Candidate {
    fn compare(&self, material: &Material, target: &Target, stored: Stored, times: Times) -> Result<Encoded> {
        let Stored { code, encode_s, decoded } = stored;
        let mut figures = target.figures(decoded.as_ref());
        figures.insert("encode_s".to_owned(), encode_s);
        let trust = Trust::of(material, &code, decoded.as_ref(), &self.known)?;
        figures.insert("expected_log_error".to_owned(), trust.expected_log_error);
        figures.extend(trust.distance.map(|distance| ("distance".to_owned(), distance)));
        let bytes = self.representation.bytes_of(&code);
        let code = (code.code.len() <= LONGEST_KEPT).then_some(code.code);
        Ok(Encoded { name: material.name.clone(), code, bytes, figures, times })
    }
}
