//! One representation over some materials: encoded, decoded, compared and timed.

use std::collections::BTreeMap;
use std::time::Instant;

use anyhow::Result;
use autoencoder::Autoencoder;
use nbrdf_core::cost::{Cost, Given, Track};
use nbrdf_core::{Code, Material, Representation};
use rayon::prelude::*;

use super::{Target, Trust};
use crate::progress;

/// Longer codes are not kept: a table's is 50 MB of text.
const LONGEST_KEPT: usize = 512;

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
    /// Of one evaluation: the median over materials.
    pub cost: Option<Cost>,
    /// One by one.
    pub materials: Vec<Encoded>,
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

    /// Measures a representation; `known` tells which error to expect, `done` is called after every material.
    pub fn measure(
        &self,
        representation: &dyn Representation,
        known: &Autoencoder,
        done: &dyn Fn(),
    ) -> Result<Quality> {
        // One after the other: side by side, their times would tell of each other.
        let encode = |material: &&Material| {
            progress::check()?;
            let start = Instant::now();
            let code = representation.encode(material)?;
            done();
            Ok((code, start.elapsed().as_secs_f64()))
        };
        let codes = self.materials.iter().map(encode).collect::<Result<Vec<_>>>()?;
        let one = |((material, target), (code, encode_s)): ((&&Material, &Target), &(Code, f64))| {
            let decoded = representation.decode(code)?;
            let mut figures = target.figures(decoded.as_ref());
            figures.insert("encode_s".to_owned(), *encode_s);
            let trust = Trust::of(material, code, decoded.as_ref(), known)?;
            figures.insert("expected_log_error".to_owned(), trust.expected_log_error);
            figures.extend(trust.distance.map(|distance| ("distance".to_owned(), distance)));
            let bytes = representation.bytes_of(code);
            let code = (code.code.len() <= LONGEST_KEPT).then(|| code.code.clone());
            Ok(Encoded { name: material.name.clone(), code, bytes, figures })
        };
        let materials = self.materials.par_iter().zip(&self.targets).zip(&codes);
        let materials = materials.map(one).collect::<Result<Vec<Encoded>>>()?;
        let mut bytes: Vec<usize> = materials.iter().map(|material| material.bytes).collect();
        bytes.sort_unstable();
        Ok(Quality {
            dim: representation.dim(),
            checkpoint: representation.checkpoint().to_owned(),
            bytes: bytes.get(bytes.len() / 2).copied().unwrap_or_default(),
            shared_bytes: representation.shared_bytes(),
            cost: self.cost(representation, &codes)?,
            materials,
        })
    }

    fn cost(&self, representation: &dyn Representation, codes: &[(Code, f64)]) -> Result<Option<Cost>> {
        let decoded: Vec<_> = codes.iter().map(|(code, _)| representation.decode(code)).collect::<Result<_, _>>()?;
        let asked: Vec<_> = decoded.iter().map(|brdf| (brdf.as_ref(), Given::Directions)).collect();
        let mut costs = self.track.measure(&asked, self.repeats);
        costs.sort_by(|a, b| a.ns.total_cmp(&b.ns));
        Ok(costs.get(costs.len() / 2).copied())
    }
}
