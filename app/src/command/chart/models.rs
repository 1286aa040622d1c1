//! Every model of a chart, measured run after run.

use anyhow::Result;
use indicatif::ProgressBar;

use crate::catalog::{Catalog, REPRESENTATIONS, RepresentationEntry};
use crate::measure::point::Point;
use crate::measure::quality::{Bench, Candidate};

/// What is measured, line by line of the catalog.
pub struct Models {
    entries: Vec<&'static RepresentationEntry>,
    candidates: Vec<Candidate>,
}

impl Models {
    /// Those of the catalog, and the codes of the other checkpoints; learns what is to be learned.
    pub fn new(catalog: &Catalog, others: &[Catalog]) -> Result<Self> {
        let codes = || REPRESENTATIONS.iter().filter(|entry| entry.name == "znbrdf");
        let others = others.iter().flat_map(|other| codes().map(move |entry| (entry, other)));
        let all: Vec<_> = REPRESENTATIONS.iter().map(|entry| (entry, catalog)).chain(others).collect();
        let candidate = |(entry, catalog): &(&RepresentationEntry, &Catalog)| -> Result<Candidate> {
            Ok(Candidate { representation: entry.build(catalog)?, known: catalog.autoencoder() })
        };
        let candidates = all.iter().map(candidate).collect::<Result<_>>()?;
        Ok(Self { entries: all.into_iter().map(|(entry, _)| entry).collect(), candidates })
    }

    /// How many.
    pub const fn count(&self) -> usize {
        self.entries.len()
    }

    /// Errors once, times in so many runs: each encodes and decodes anew, so that nothing is held between them.
    pub fn measure(&self, bench: &Bench, runs: usize, bar: &ProgressBar) -> Result<Vec<Point>> {
        let qualities = bench.measure(&self.candidates, &|| bar.inc(1))?;
        let mut times: Vec<Vec<_>> = qualities.iter().map(|quality| Vec::from_iter(quality.times)).collect();
        for _ in 1..runs {
            for (times, own) in times.iter_mut().zip(bench.times(&self.candidates, &|| bar.inc(1))?) {
                times.extend(own);
            }
        }
        let all = self.entries.iter().zip(&qualities).zip(times);
        Ok(all.filter_map(|((entry, quality), times)| Point::of(entry, quality, times)).collect())
    }
}
