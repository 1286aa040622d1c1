//! What a scene costs.

use super::choose::{Candidate, Tally};
use super::planner::Planner;
use crate::scene::Demand;

/// What a scene costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    /// Evaluations of a picture.
    pub evaluations: usize,
    /// Nanoseconds of all evaluations, one thread.
    pub ns: f64,
    /// Bytes of all models, what is shared counted once.
    pub bytes: usize,
}

impl Planner<'_> {
    /// With one model for every object.
    pub(super) fn totals(&self, own: &[Candidate]) -> Totals {
        let counts = || self.view().demands().iter().map(Demand::evaluations);
        let mut tally = Tally::default();
        self.material.iter().zip(own).for_each(|(&material, own)| tally.add(material, own));
        Totals {
            evaluations: counts().sum(),
            ns: counts().zip(own).map(|(count, own)| count as f64 * own.ns).sum(),
            bytes: tally.bytes(),
        }
    }
}
