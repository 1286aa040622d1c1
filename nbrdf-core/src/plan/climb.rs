//! The walk up the ladder: which models serve an object.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::planner::{Key, Known, Planner};
use super::{By, Options, PlanError, Watch};

/// A model whose error is estimated to be this many times the tolerance is not looked at in the picture.
const FAR_OFF: f64 = 2.0;
/// Rungs that may turn out cheaper than the first good one, by as much as times, and bytes, differ between materials.
const SLACK: [f64; 2] = [1.3, 1.6];
/// What is farther off than this in more bits is not nearer in fewer; rounding may be lucky.
const ROUNDING: f64 = 1.25;

/// What is looked for, and who watches.
#[derive(Clone, Copy)]
pub(super) struct Walk<'a> {
    pub options: Options,
    /// Models that are given up.
    pub refused: &'a BTreeSet<Key>,
    pub watch: &'a Watch<'a>,
}

impl Planner<'_> {
    /// The rungs that serve each object. Materials go in parallel, objects of one material one after the other, so that
    /// no model is made twice.
    pub(super) fn walk(&self, walk: &Walk) -> Result<Vec<Vec<usize>>, PlanError> {
        let objects_of = |material: usize| (0..self.material.len()).filter(move |&o| self.material[o] == material);
        let one = |material: usize| {
            let walks = objects_of(material).map(|object| Ok((object, self.climb(object, walk)?)));
            walks.collect::<Result<Vec<_>, PlanError>>()
        };
        let walks = (0..self.models.materials.len()).into_par_iter().map(one).collect::<Result<Vec<_>, PlanError>>()?;
        let mut all: Vec<(usize, Vec<usize>)> = walks.into_iter().flatten().collect();
        all.sort_by_key(|(object, _)| *object);
        let mut within: Vec<Vec<usize>> = all.into_iter().map(|(_, rungs)| rungs).collect();
        if !walk.options.exhaustive {
            self.offer_shared(&mut within, walk)?;
            self.offer_siblings(&mut within, walk)?;
        }
        Ok(within)
    }

    /// What serves one object may serve others of the same material, and is there already.
    fn offer_siblings(&self, within: &mut [Vec<usize>], walk: &Walk) -> Result<(), PlanError> {
        for object in 0..within.len() {
            let siblings = (0..within.len()).filter(|&other| self.material[other] == self.material[object]);
            let rungs: BTreeSet<usize> = siblings.flat_map(|other| within[other].iter().copied()).collect();
            for rung in rungs {
                if !within[object].contains(&rung) && self.serves(object, rung, walk)? {
                    within[object].push(rung);
                }
            }
        }
        Ok(())
    }

    /// One object's walk, from the cheapest model up until no other can be cheaper than what was found.
    pub(super) fn climb(&self, object: usize, walk: &Walk) -> Result<Vec<usize>, PlanError> {
        let Walk { options, .. } = *walk;
        let slack = SLACK[usize::from(options.by == By::Bytes)];
        let (mut within, mut least) = (Vec::new(), f64::INFINITY);
        for (cost, rung) in self.order(object, options)? {
            if !options.exhaustive && cost > slack * least {
                break;
            }
            if self.serves(object, rung, walk)? {
                within.push(rung);
                least = least.min(cost);
            }
        }
        Ok(within)
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
    fn offer_shared(&self, within: &mut [Vec<usize>], walk: &Walk) -> Result<(), PlanError> {
        let Walk { options, .. } = *walk;
        for (rung, kind) in self.models.ladder.iter().enumerate() {
            let Some((_, shared)) = kind.shared.as_ref().filter(|_| kind.bytes <= options.most_bytes) else { continue };
            let mut objects = Vec::new();
            let (mut saved, mut is_faster) = (0_usize, false);
            for (object, rungs) in within.iter().enumerate() {
                let (mut ns, mut bytes) = (f64::INFINITY, usize::MAX);
                for &own in rungs {
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
                    if self.serves(object, rung, walk)? {
                        within[object].push(rung);
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether a model is within the tolerance, and was not given up.
    pub(super) fn serves(&self, object: usize, rung: usize, walk: &Walk) -> Result<bool, PlanError> {
        let Walk { options, refused, watch } = *walk;
        if refused.contains(&(object, rung)) {
            return Ok(false);
        }
        if (watch.cancelled)() {
            return Err(PlanError::Cancelled);
        }
        if let Some(finer) = self.models.ladder[rung].coarser_than.filter(|_| !options.exhaustive)
            && !self.serves(object, finer, walk)?
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
