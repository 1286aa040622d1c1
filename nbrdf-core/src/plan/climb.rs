//! The walk up the ladder: which models serve an object.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::planner::{Found, Known, Planner};
use super::{By, Options, PlanError, Watch};

/// A model whose error is estimated to be this many times the tolerance is not looked at in the picture.
const FAR_OFF: f64 = 2.0;
/// Rungs that may turn out cheaper than the first good one, by as much as times, and bytes, differ between materials.
const SLACK: [f64; 2] = [1.3, 1.6];
/// What is farther off than this in more bits is not nearer in fewer; rounding may be lucky.
const ROUNDING: f64 = 1.25;

impl Planner<'_> {
    /// What every object can choose from. Materials go in parallel, objects of one material one after the other, so that
    /// no model is made twice.
    pub(super) fn walk(
        &self,
        options: Options,
        refused: &BTreeSet<(usize, usize)>,
        watch: &Watch,
    ) -> Result<Vec<Found>, PlanError> {
        let objects_of = |material: usize| (0..self.material.len()).filter(move |&o| self.material[o] == material);
        let one = |material: usize| {
            let walks = objects_of(material).map(|object| Ok((object, self.climb(object, options, refused, watch)?)));
            walks.collect::<Result<Vec<_>, PlanError>>()
        };
        let walks = (0..self.models.materials.len()).into_par_iter().map(one).collect::<Result<Vec<_>, PlanError>>()?;
        let mut all: Vec<(usize, Found)> = walks.into_iter().flatten().collect();
        all.sort_by_key(|(object, _)| *object);
        let mut found: Vec<Found> = all.into_iter().map(|(_, found)| found).collect();
        if !options.exhaustive {
            self.offer_shared(&mut found, options, refused, watch)?;
            self.offer_siblings(&mut found, options, refused, watch)?;
        }
        Ok(found)
    }

    /// What serves one object may serve others of the same material, and is there already.
    fn offer_siblings(
        &self,
        found: &mut [Found],
        options: Options,
        refused: &BTreeSet<(usize, usize)>,
        watch: &Watch,
    ) -> Result<(), PlanError> {
        for object in 0..found.len() {
            let siblings = (0..found.len()).filter(|&other| self.material[other] == self.material[object]);
            let rungs: BTreeSet<usize> = siblings.flat_map(|other| found[other].within.iter().copied()).collect();
            for rung in rungs {
                let is_new = !found[object].within.contains(&rung) && !refused.contains(&(object, rung));
                if is_new && self.serves(object, rung, options, watch)? {
                    found[object].within.push(rung);
                }
            }
        }
        Ok(())
    }

    /// One object's walk, from the cheapest model up until no other can be cheaper than what was found.
    pub(super) fn climb(
        &self,
        object: usize,
        options: Options,
        refused: &BTreeSet<(usize, usize)>,
        watch: &Watch,
    ) -> Result<Found, PlanError> {
        let slack = SLACK[usize::from(options.by == By::Bytes)];
        let (mut within, mut least) = (Vec::new(), f64::INFINITY);
        for (cost, rung) in self.order(object, options)? {
            if !options.exhaustive && cost > slack * least {
                break;
            }
            if !refused.contains(&(object, rung)) && self.serves(object, rung, options, watch)? {
                within.push(rung);
                least = least.min(cost);
            }
        }
        // Another form of the same network is the material itself, too.
        let is_other = |rung: &usize| self.known(object, *rung).error != Some(0.0);
        let is_alone = !within.iter().any(is_other);
        let tried = (0..self.models.ladder.len()).filter(|&rung| is_alone && !refused.contains(&(object, rung)));
        let tried = tried.filter(is_other).filter_map(|rung| {
            let Known { error, estimate } = self.known(object, rung);
            Some((rung, error.or(estimate).filter(|error| error.is_finite())?))
        });
        let closest = tried.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(rung, _)| rung);
        Ok(Found { within, closest })
    }

    /// Rungs without shared parts from the cheapest up, with what they are expected to cost; all where nothing is to be
    /// left out.
    pub(super) fn order(&self, object: usize, options: Options) -> Result<Vec<(f64, usize)>, PlanError> {
        let mut order = Vec::new();
        for (rung, kind) in self.models.ladder.iter().enumerate() {
            let is_small = kind.bytes <= options.most_bytes || kind.is_itself;
            if is_small && (options.exhaustive || kind.shared.is_none()) {
                order.push((self.expected(object, rung, options.by)?, rung));
            }
        }
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(order)
    }

    /// Models with a part that all share, where that part can pay for itself.
    fn offer_shared(
        &self,
        found: &mut [Found],
        options: Options,
        refused: &BTreeSet<(usize, usize)>,
        watch: &Watch,
    ) -> Result<(), PlanError> {
        for (rung, kind) in self.models.ladder.iter().enumerate() {
            let Some((_, shared)) = kind.shared.as_ref().filter(|_| kind.bytes <= options.most_bytes) else { continue };
            let mut objects = Vec::new();
            let (mut saved, mut is_faster) = (0_usize, false);
            for (object, found) in found.iter().enumerate() {
                let (mut ns, mut bytes) = (f64::INFINITY, usize::MAX);
                for &own in &found.within {
                    ns = ns.min(self.expected(object, own, By::Time)?);
                    bytes = bytes.min(self.model(object, own)?.bytes);
                }
                if options.by == By::Bytes || kind.ns <= SLACK[0] * ns {
                    objects.push(object);
                    saved = saved.saturating_add(bytes.saturating_sub(kind.bytes));
                    is_faster |= options.by == By::Time && kind.ns * SLACK[0] < ns;
                }
            }
            if saved > *shared || is_faster {
                for object in objects {
                    if !refused.contains(&(object, rung)) && self.serves(object, rung, options, watch)? {
                        found[object].within.push(rung);
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether a model is within the tolerance.
    pub(super) fn serves(
        &self,
        object: usize,
        rung: usize,
        options: Options,
        watch: &Watch,
    ) -> Result<bool, PlanError> {
        if (watch.cancelled)() {
            return Err(PlanError::Cancelled);
        }
        if let Some(finer) = self.models.ladder[rung].coarser_than.filter(|_| !options.exhaustive)
            && !self.serves(object, finer, options, watch)?
        {
            let Known { estimate, error } = self.known(object, finer);
            if error.or(estimate).is_none_or(|error| error > ROUNDING * options.tolerance) {
                return Ok(false);
            }
        }
        let Known { estimate, error } = self.known(object, rung);
        if let Some(error) = error {
            return Ok(error <= options.tolerance);
        }
        let limit = FAR_OFF * options.tolerance;
        if estimate.is_some_and(|estimate| estimate == f64::INFINITY || (!options.exhaustive && estimate > limit)) {
            return Ok(false);
        }
        // A material that this kind of model cannot hold is not served by it.
        let Ok(model) = self.model(object, rung) else {
            self.keep(object, rung, Known { estimate: Some(f64::INFINITY), error: None });
            return Ok(false);
        };
        (watch.tried)(object, &self.models.ladder[rung].name);
        let estimate = if options.exhaustive { None } else { self.judge.estimate(object, model.brdf.as_ref()) };
        if estimate.is_some_and(|estimate| estimate > limit) {
            self.keep(object, rung, Known { estimate, error: None });
            return Ok(false);
        }
        let error = self.judge.error(object, model.brdf.as_ref());
        self.keep(object, rung, Known { estimate, error: Some(error) });
        Ok(error <= options.tolerance)
    }

    /// What a model will cost before it is made; the material itself is there from the beginning.
    fn expected(&self, object: usize, rung: usize, by: By) -> Result<f64, PlanError> {
        let kind = &self.models.ladder[rung];
        let is_itself = kind.is_itself;
        Ok(match by {
            By::Time if is_itself => self.bench_ns(object, rung).unwrap_or(kind.ns),
            By::Bytes if is_itself => self.model(object, rung)?.bytes as f64,
            By::Time => kind.ns,
            By::Bytes => kind.bytes as f64,
        })
    }
}
