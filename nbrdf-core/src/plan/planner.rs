//! A model for every object: walk, time, choose, look at the whole, walk again where neighbours spoil it.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

use super::bench::Bench;
use super::choose::{Candidate, Seat, choose};
use super::climb::Walk;
use super::judge::Judge;
use super::models::Models;
use super::{Choice, Model, Options, Plan, PlanError, Rung, Watch};
use crate::scene::View;
use crate::{Brdf, Image};

/// Finds plans of one view; errors that were found once are kept, so that another tolerance costs little.
pub struct Planner<'a> {
    pub(super) judge: Judge<'a>,
    pub(super) models: &'a Models<'a>,
    /// The material of every object.
    pub(super) material: &'a [usize],
    /// The rung of the materials themselves.
    pub(super) itself: usize,
    bench: Bench,
    /// Of every object and rung: its error in the picture, or what was estimated.
    errors: Vec<Vec<Mutex<Known>>>,
}

/// What is known of a model in the picture.
#[derive(Clone, Copy, Default)]
pub(super) struct Known {
    pub estimate: Option<f64>,
    pub error: Option<f64>,
}

/// Object and rung.
pub(super) type Key = (usize, usize);

impl<'a> Planner<'a> {
    /// Of a view whose objects are of these materials, by their places.
    ///
    /// # Errors
    /// [`PlanError::Encode`]: a material that cannot be used at all.
    ///
    /// # Panics
    /// If the ladder has no rung for the materials themselves (a bug of the caller).
    pub fn new(view: &'a View, models: &'a Models<'a>, material: &'a [usize]) -> Result<Self, PlanError> {
        let own: Vec<&dyn Brdf> = material.iter().map(|&place| models.materials[place].brdf.as_ref()).collect();
        let judge = Judge::new(view, &own);
        let errors = own.iter().map(|_| models.ladder.iter().map(|_| Mutex::default()).collect()).collect();
        let itself =
            models.ladder.iter().position(|kind| kind.is_itself).expect("the materials themselves on the ladder");
        let planner = Self { judge, models, material, itself, bench: Bench::default(), errors };
        for object in 0..material.len() {
            planner.keep(object, itself, Known { estimate: None, error: Some(0.0) });
        }
        planner.time(&(0..material.len()).map(|object| (object, itself)).collect::<Vec<_>>())?;
        Ok(planner)
    }

    /// The view.
    pub const fn view(&self) -> &View {
        self.judge.view()
    }

    /// The linear picture of the materials themselves.
    pub const fn reference(&self) -> &Image {
        self.judge.reference()
    }

    /// The models it chooses from.
    pub const fn models(&self) -> &'a Models<'a> {
        self.models
    }

    /// Pixels that an object's error is the mean of.
    pub fn pixels(&self, object: usize) -> usize {
        self.judge.pixels(object)
    }

    /// A model for every object.
    ///
    /// # Errors
    /// [`PlanError`]: cancelled, or a material that cannot be used at all.
    pub fn plan(&self, options: Options, watch: &Watch) -> Result<Plan, PlanError> {
        let mut refused = BTreeSet::new();
        loop {
            let within = self.walk(&Walk { options, refused: &refused, watch })?;
            let beside = self.beside(options, watch)?;
            let seats = self.seats(&within, &beside, refused.is_empty())?;
            let chosen: Vec<usize> =
                choose(&seats, options.by).into_iter().zip(&within).map(|(i, rungs)| rungs[i]).collect();
            let models = self.keyed(&chosen.iter().copied().enumerate().collect::<Vec<_>>())?;
            let own: Vec<&dyn Brdf> = models.iter().map(|(_, model)| model.brdf.as_ref()).collect();
            let (planned, errors) = self.judge.together(&own);
            // Neighbours are seen together: what was good enough alone may not be beside others.
            let over = (0..errors.len()).filter(|&object| errors[object] > options.tolerance);
            let before = refused.len();
            refused.extend(over.filter_map(|object| self.to_refuse(object, &chosen, &errors)));
            if refused.len() == before {
                let closest = within.iter().enumerate().map(|(object, rungs)| self.closest(object, rungs, &refused));
                return self.finished(&closest.collect::<Vec<_>>(), &chosen, &errors, planned, &beside);
            }
        }
    }

    /// The model to give up where an object is over the tolerance: its own, or where that is the material itself, that of the
    /// worst other.
    fn to_refuse(&self, object: usize, chosen: &[usize], errors: &[f64]) -> Option<Key> {
        let is_model = |&other: &usize| chosen[other] != self.itself;
        let own = Some(object).filter(is_model);
        let others = || (0..errors.len()).filter(is_model).filter(|&other| self.judge.touch(object, other));
        let worst = own.or_else(|| others().max_by(|&a, &b| errors[a].total_cmp(&errors[b])))?;
        Some((worst, chosen[worst]))
    }

    /// What the plan is compared with, object by object; nothing where a material has no such model.
    fn beside(&self, options: Options, watch: &Watch) -> Result<Vec<Key>, PlanError> {
        let Some(rung) = options.beside else { return Ok(Vec::new()) };
        for &material in self.material {
            if (watch.cancelled)() {
                return Err(PlanError::Cancelled);
            }
            if self.models.get(material, rung).is_err() {
                return Ok(Vec::new());
            }
        }
        Ok((0..self.material.len()).map(|object| (object, rung)).collect())
    }

    /// Where nothing but the material itself is within the tolerance: the closest of the others that were tried.
    fn closest(&self, object: usize, within: &[usize], refused: &BTreeSet<Key>) -> Option<usize> {
        // Another form of the same network is the material itself, too.
        let is_other = |rung: &usize| self.known(object, *rung).error != Some(0.0);
        if within.iter().any(is_other) {
            return None;
        }
        let others = (0..self.models.ladder.len()).filter(|&rung| !refused.contains(&(object, rung))).filter(is_other);
        let tried = others.filter_map(|rung| {
            let Known { error, estimate } = self.known(object, rung);
            Some((rung, error.or(estimate).filter(|error| error.is_finite())?))
        });
        tried.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(rung, _)| rung)
    }

    fn finished(
        &self,
        closest: &[Option<usize>],
        chosen: &[usize],
        errors: &[f64],
        planned: Image,
        beside: &[Key],
    ) -> Result<Plan, PlanError> {
        let candidates = |keys: &mut dyn Iterator<Item = Key>| {
            keys.map(|(object, rung)| self.candidate(object, rung)).collect::<Result<Vec<_>, PlanError>>()
        };
        let own = candidates(&mut chosen.iter().copied().enumerate())?;
        let others = candidates(&mut beside.iter().copied())?;
        let choice = |object: usize| {
            let (rung, Candidate { ns, bytes, .. }) = (chosen[object], own[object]);
            let unmet = closest[object].map(|rung| Ok((rung, self.error(object, rung)?))).transpose();
            let beside = others.get(object).map(|other| (other.ns, other.bytes));
            Ok(Choice { rung, error: errors[object], ns, bytes, unmet: unmet?, beside })
        };
        Ok(Plan {
            choices: (0..chosen.len()).map(choice).collect::<Result<_, PlanError>>()?,
            reference: self.judge.reference().clone(),
            planned,
            totals: self.totals(&own),
            beside: (!others.is_empty()).then(|| self.totals(&others)),
            tried: self.models.count(),
        })
    }

    /// The error of a model in the picture, looked at now if it was only estimated.
    pub(super) fn error(&self, object: usize, rung: usize) -> Result<f64, PlanError> {
        let known = self.known(object, rung);
        if let Some(error) = known.error {
            return Ok(error);
        }
        let model = self.model(object, rung)?;
        let error = self.judge.error(object, model.brdf.as_ref());
        self.keep(object, rung, Known { error: Some(error), ..known });
        Ok(error)
    }

    /// What an object's model costs, once it was timed.
    pub(super) fn candidate(&self, object: usize, rung: usize) -> Result<Candidate, PlanError> {
        let kind = &self.models.ladder[rung];
        let shares = |other: &Rung, name: &String| other.shared.as_ref().is_some_and(|(own, _)| own == name);
        let number = |name: &String| self.models.ladder.iter().position(|other| shares(other, name)).unwrap_or(rung);
        Ok(Candidate {
            rung,
            ns: self.bench_ns(object, rung).unwrap_or(kind.ns),
            bytes: self.model(object, rung)?.bytes,
            shared: kind.shared.as_ref().map(|(name, bytes)| (number(name), *bytes)),
        })
    }

    /// What all objects can choose from, and what the plan is compared with, timed in one run.
    fn seats(&self, within: &[Vec<usize>], beside: &[Key], anew: bool) -> Result<Vec<Seat>, PlanError> {
        let own = within.iter().enumerate().flat_map(|(object, rungs)| rungs.iter().map(move |&rung| (object, rung)));
        let keys: Vec<Key> = own.chain(beside.iter().copied()).collect();
        if anew {
            self.time_anew(&keys)?;
        } else {
            self.time(&keys)?;
        }
        within.iter().enumerate().map(|(object, rungs)| self.seat(object, rungs)).collect()
    }

    /// What an object can choose from, timed.
    pub(super) fn seat(&self, object: usize, within: &[usize]) -> Result<Seat, PlanError> {
        let candidates = within.iter().map(|&rung| self.candidate(object, rung)).collect::<Result<_, PlanError>>()?;
        Ok(Seat { material: self.material[object], candidates })
    }

    /// Times models that were not timed yet.
    pub(super) fn time(&self, keys: &[Key]) -> Result<(), PlanError> {
        let is_new = |&&(object, rung): &&Key| self.bench_ns(object, rung).is_none();
        self.time_anew(&keys.iter().filter(is_new).copied().collect::<Vec<_>>())
    }

    fn time_anew(&self, keys: &[Key]) -> Result<(), PlanError> {
        let models = self.keyed(keys)?;
        let models: Vec<_> = models.iter().map(|(key, model)| (*key, model.brdf.as_ref())).collect();
        self.bench.measure(&models, self.view().demands());
        Ok(())
    }

    /// Takes over how long another one's models have taken, so that two plans differ in nothing but what they tried.
    pub fn take_times(&self, other: &Self) {
        self.bench.take(&other.bench);
    }

    fn keyed(&self, keys: &[Key]) -> Result<Vec<(Key, Arc<Model>)>, PlanError> {
        keys.iter().map(|&(object, rung)| Ok(((object, rung), self.model(object, rung)?))).collect()
    }

    /// The model of an object on a rung.
    pub(super) fn model(&self, object: usize, rung: usize) -> Result<Arc<Model>, PlanError> {
        self.models.get(self.material[object], rung).map_err(PlanError::Encode)
    }

    pub(super) fn bench_ns(&self, object: usize, rung: usize) -> Option<f64> {
        self.bench.ns((object, rung))
    }

    pub(super) fn known(&self, object: usize, rung: usize) -> Known {
        *self.errors[object][rung].lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn keep(&self, object: usize, rung: usize, known: Known) {
        *self.errors[object][rung].lock().unwrap_or_else(PoisonError::into_inner) = known;
    }
}
