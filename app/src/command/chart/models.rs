//! Every model of a chart, measured run after run.

use anyhow::Result;
use indicatif::ProgressBar;

use super::files::tell_apart;
use crate::catalog::{Catalog, REPRESENTATIONS, RepresentationEntry};
use crate::measure::point::Point;
use crate::measure::quality::{Bench, Candidate};

/// What is measured.
pub struct Models {
    /// Lines of the catalog, with the file of those that another checkpoint decodes.
    entries: Vec<(&'static RepresentationEntry, Option<String>)>,
    candidates: Vec<Candidate>,
}

impl Models {
    /// Those of the catalog, and the codes of the other checkpoints, by their names; learns what is to be learned.
    pub fn new(catalog: &Catalog, others: impl IntoIterator<Item = (Catalog, String)>) -> Result<Self> {
        let mut models = Self { entries: Vec::new(), candidates: Vec::new() };
        for entry in REPRESENTATIONS {
            models.add(entry, catalog, None)?;
        }
        for (other, file) in others {
            for entry in REPRESENTATIONS.iter().filter(|entry| entry.name == "znbrdf") {
                models.add(entry, &other, Some(file.clone()))?;
            }
        }
        Ok(models)
    }

    fn add(&mut self, entry: &'static RepresentationEntry, catalog: &Catalog, file: Option<String>) -> Result<()> {
        self.candidates.push(Candidate { representation: entry.build(catalog)?, known: catalog.autoencoder() });
        self.entries.push((entry, file));
        Ok(())
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
        let mut points = Vec::new();
        for (((entry, file), quality), times) in self.entries.iter().zip(&qualities).zip(times) {
            points.extend(Point::of(entry, quality, times).map(|point| Point { file: file.clone(), ..point }));
        }
        tell_apart(&mut points);
        Ok(points)
    }
}
