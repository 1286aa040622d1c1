//! What was looked at on the way to a plan.

use super::Planner;

/// A model that was looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tried {
    /// Place of its kind on the ladder.
    pub rung: usize,
    /// Mean FLIP on the object's pixels, everything else being itself.
    pub error: f64,
    /// Whether the error is that of some of the pixels, colour by colour: what is far off is not looked at closer.
    pub is_estimate: bool,
}

impl Planner<'_> {
    /// What was tried of an object so far, for any tolerance, in the order of the ladder; the material itself is left out.
    pub fn tried(&self, object: usize) -> Vec<Tried> {
        let tried = |rung: usize| {
            let known = self.known(object, rung);
            let error = known.error.or(known.estimate).filter(|error| error.is_finite())?;
            Some(Tried { rung, error, is_estimate: known.error.is_none() })
        };
        (0..self.models.ladder.len()).filter(|&rung| rung != self.itself).filter_map(tried).collect()
    }
}
