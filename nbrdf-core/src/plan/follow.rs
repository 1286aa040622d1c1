//! One object's model while its distance changes: no more switches than needed, and none that is seen.

use std::collections::BTreeSet;

use super::choose::choose;
use super::climb::Walk;
use super::planner::Planner;
use super::{By, Options, PlanError, Watch};

/// A cheaper model takes over when its error is below the first share of the tolerance, and leaves when it is above the
/// second: in between, whoever is there stays, and who leaves does so before the difference to the next is seen.
pub const TAKES_OVER: f64 = 0.75;
/// See [`TAKES_OVER`].
pub const LEAVES: f64 = 0.95;
/// A model that takes over is faster by this factor: less is not worth a change, and may be noise.
const WORTH_IT: f64 = 1.25;

/// An object's model at one distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Followed {
    /// Place of its kind on the ladder.
    pub rung: usize,
    /// Mean FLIP on the object's pixels.
    pub error: f64,
    /// Nanoseconds per evaluation.
    pub ns: f64,
    /// Where it has taken over here: mean FLIP between it and the one before.
    pub change: Option<f64>,
}

impl Planner<'_> {
    /// The model of an object that had `before` at a neighbouring distance, by time whatever the options say.
    ///
    /// # Errors
    /// [`PlanError`]: cancelled, or a material that cannot be encoded.
    pub fn follow(
        &self,
        object: usize,
        before: Option<usize>,
        options: Options,
        watch: &Watch,
    ) -> Result<Followed, PlanError> {
        let refused = BTreeSet::new();
        let within = |share: f64| {
            let options = Options { by: By::Time, exhaustive: false, tolerance: share * options.tolerance, ..options };
            Walk { options, refused: &refused, watch }
        };
        let Some(before) = before else {
            return self.followed(object, self.best(object, &within(LEAVES))?, None);
        };
        let rung = if self.serves(object, before, &within(LEAVES))? {
            let other = self.best(object, &within(TAKES_OVER))?;
            let is_worth_it = self.ns(object, other)? * WORTH_IT < self.ns(object, before)?;
            let is_smooth = is_worth_it && self.change(object, before, other)? <= options.tolerance;
            if is_smooth { other } else { before }
        } else {
            self.smoothest(object, before, options.tolerance, &within(LEAVES))?
        };
        self.followed(object, rung, Some(before))
    }

    /// The cheapest model within the tolerance whose picture is within `change` of the one before, else the nearest to it.
    fn smoothest(&self, object: usize, before: usize, change: f64, walk: &Walk) -> Result<usize, PlanError> {
        let mut nearest = (f64::INFINITY, self.itself);
        for (_, rung) in self.order(object, walk.options)? {
            if self.serves(object, rung, walk)? {
                let own = self.change(object, before, rung)?;
                if own <= change {
                    return Ok(rung);
                }
                if own < nearest.0 {
                    nearest = (own, rung);
                }
            }
        }
        Ok(nearest.1)
    }

    fn followed(&self, object: usize, rung: usize, before: Option<usize>) -> Result<Followed, PlanError> {
        let change = before.filter(|&before| before != rung).map(|before| self.change(object, before, rung));
        let (error, ns) = (self.error(object, rung)?, self.ns(object, rung)?);
        Ok(Followed { rung, error, ns, change: change.transpose()? })
    }

    /// What a plan of this object alone would choose.
    fn best(&self, object: usize, walk: &Walk) -> Result<usize, PlanError> {
        let within = self.climb(object, walk)?;
        self.time(&within.iter().map(|&rung| (object, rung)).collect::<Vec<_>>())?;
        let chosen = choose(&[self.seat(object, &within)?], walk.options.by);
        Ok(within[chosen[0]])
    }

    fn ns(&self, object: usize, rung: usize) -> Result<f64, PlanError> {
        self.time(&[(object, rung)])?;
        Ok(self.candidate(object, rung)?.ns)
    }

    fn change(&self, object: usize, one: usize, other: usize) -> Result<f64, PlanError> {
        let [one, other] = [one, other].map(|rung| self.model(object, rung));
        Ok(self.judge.between(object, one?.brdf.as_ref(), other?.brdf.as_ref()))
    }
}
