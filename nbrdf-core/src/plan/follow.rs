//! One object's model while its distance changes: no more switches than needed, and none that is seen.

use std::collections::BTreeSet;

use super::choose::{Seat, choose};
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
        let options =
            |share: f64| Options { by: By::Time, exhaustive: false, tolerance: share * options.tolerance, ..options };
        let Some(before) = before else {
            return self.followed(object, self.best(object, options(LEAVES), watch)?, None);
        };
        let rung = if self.serves(object, before, options(LEAVES), watch)? {
            let other = self.best(object, options(TAKES_OVER), watch)?;
            let is_worth_it = self.ns(object, other)? * WORTH_IT < self.ns(object, before)?;
            let is_smooth = is_worth_it && self.change(object, before, other)? <= options(1.0).tolerance;
            if is_smooth { other } else { before }
        } else {
            self.smoothest(object, before, options(LEAVES), options(1.0).tolerance, watch)?
        };
        self.followed(object, rung, Some(before))
    }

    /// The cheapest model within the tolerance whose picture is within `change` of the one before, else the nearest to it.
    fn smoothest(
        &self,
        object: usize,
        before: usize,
        options: Options,
        change: f64,
        watch: &Watch,
    ) -> Result<usize, PlanError> {
        let mut nearest = (f64::INFINITY, self.itself);
        for (_, rung) in self.order(object, options)? {
            if self.serves(object, rung, options, watch)? {
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
        let model = self.model(object, rung)?;
        let change = before.filter(|&before| before != rung).map(|before| self.change(object, before, rung));
        Ok(Followed {
            rung,
            error: self.judge.error(object, model.brdf.as_ref()),
            ns: self.ns(object, rung)?,
            change: change.transpose()?,
        })
    }

    /// What a plan of this object alone would choose.
    fn best(&self, object: usize, options: Options, watch: &Watch) -> Result<usize, PlanError> {
        let within = self.climb(object, options, &BTreeSet::new(), watch)?.within;
        self.time(&within.iter().map(|&rung| (object, rung)).collect::<Vec<_>>())?;
        let candidates = within.iter().map(|&rung| self.candidate(object, rung)).collect::<Result<_, PlanError>>()?;
        let chosen = choose(&[Seat { material: self.material[object], candidates }], options.by);
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
