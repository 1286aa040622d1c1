//! The walk up the ladder, object by object.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

use super::bench::Bench;
use super::choose::{Candidate, Seat, choose, total_bytes};
use super::judge::Judge;
use super::models::Models;
use super::{Choice, Model, Options, Plan, PlanError, Rung, Watch};
use crate::scene::{Demand, View};
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

/// What one object can choose from.
pub(super) struct Found {
    /// Rungs within the tolerance.
    pub within: Vec<usize>,
    /// The closest of the others.
    pub closest: Option<(usize, f64)>,
}

impl<'a> Planner<'a> {
    /// Of a view whose objects are of these materials, by their places.
    ///
    /// # Errors
    /// [`PlanError::Encode`]: a material that cannot be evaluated.
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
        planner.time(&(0..material.len()).map(|object| (object, itself)).collect::<Vec<_>>())?;
        Ok(planner)
    }

    /// The view.
    pub const fn view(&self) -> &View {
        self.judge.view()
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
    /// [`PlanError`]: cancelled, or a material that cannot be encoded.
    pub fn plan(&self, options: Options, watch: &Watch) -> Result<Plan, PlanError> {
        let mut refused = BTreeSet::new();
        loop {
            let found = self.walk(options, &refused, watch)?;
            let seats = self.seats(&found)?;
            let chosen: Vec<usize> =
                choose(&seats, options.by).into_iter().zip(&found).map(|(i, found)| found.within[i]).collect();
            let models = self.chosen_models(&chosen)?;
            let own: Vec<&dyn Brdf> = models.iter().map(|model| model.brdf.as_ref()).collect();
            let (planned, errors) = self.judge.together(&own);
            // Neighbours are seen together: what was good enough alone may not be beside others.
            let over = (0..errors.len()).filter(|&object| errors[object] > options.tolerance);
            let before = refused.len();
            refused.extend(over.filter_map(|object| self.to_refuse(object, &chosen, &errors)));
            if refused.len() == before {
                return self.finished(&found, &chosen, &errors, planned);
            }
        }
    }

    /// The model to give up where an object is over the tolerance: its own, or where that is the material itself, that of the
    /// worst other.
    fn to_refuse(&self, object: usize, chosen: &[usize], errors: &[f64]) -> Option<(usize, usize)> {
        let is_model = |&other: &usize| self.known(other, chosen[other]).error != Some(0.0);
        let own = Some(object).filter(is_model);
        let others = || (0..errors.len()).filter(is_model).filter(|&other| self.judge.touch(object, other));
        let worst = own.or_else(|| others().max_by(|&a, &b| errors[a].total_cmp(&errors[b])))?;
        Some((worst, chosen[worst]))
    }

    fn finished(&self, found: &[Found], chosen: &[usize], errors: &[f64], planned: Image) -> Result<Plan, PlanError> {
        let choice = |object: usize| {
            let rung = chosen[object];
            let candidate = self.candidate(object, rung)?;
            let is_itself = self.known(object, rung).error == Some(0.0);
            let unmet = found[object].closest.filter(|_| is_itself);
            Ok(Choice { rung, error: errors[object], ns: candidate.ns, bytes: candidate.bytes, unmet })
        };
        Ok(Plan {
            choices: (0..chosen.len()).map(choice).collect::<Result<_, PlanError>>()?,
            reference: self.judge.reference().clone(),
            planned,
            totals: self.totals(chosen)?,
            tried: self.models.count(),
        })
    }

    /// What the scene costs with one kind of model for everything.
    ///
    /// # Errors
    /// [`PlanError::Encode`]: a material that has no such model.
    pub fn everywhere(&self, rung: usize) -> Result<Totals, PlanError> {
        self.totals(&vec![rung; self.material.len()])
    }

    fn totals(&self, chosen: &[usize]) -> Result<Totals, PlanError> {
        self.time(&chosen.iter().copied().enumerate().collect::<Vec<_>>())?;
        let own = (0..chosen.len()).map(|object| self.candidate(object, chosen[object]));
        let own = own.collect::<Result<Vec<_>, PlanError>>()?;
        let counts = self.view().demands().iter().map(Demand::evaluations);
        Ok(Totals {
            evaluations: counts.clone().sum(),
            ns: counts.zip(&own).map(|(count, own)| count as f64 * own.ns).sum(),
            bytes: total_bytes(self.material.iter().copied().zip(&own)),
        })
    }

    /// What an object's model costs, once it was timed.
    pub(super) fn candidate(&self, object: usize, rung: usize) -> Result<Candidate, PlanError> {
        let material = self.material[object];
        let kind = &self.models.ladder[rung];
        let shares = |other: &Rung, name: &String| other.shared.as_ref().is_some_and(|(own, _)| own == name);
        let number = |name: &String| self.models.ladder.iter().position(|other| shares(other, name)).unwrap_or(rung);
        Ok(Candidate {
            rung,
            ns: self.bench.ns((object, rung)).unwrap_or(kind.ns),
            bytes: self.models.get(material, rung)?.bytes,
            shared: kind.shared.as_ref().map(|(name, bytes)| (number(name), *bytes)),
        })
    }

    /// What all objects can choose from, timed.
    fn seats(&self, found: &[Found]) -> Result<Vec<Seat>, PlanError> {
        let within = |(object, found): (usize, &Found)| found.within.iter().map(move |&rung| (object, rung)).collect();
        let keys: Vec<(usize, usize)> = found.iter().enumerate().flat_map(|own| -> Vec<_> { within(own) }).collect();
        self.time(&keys)?;
        let seat = |(object, found): (usize, &Found)| {
            let candidates = found.within.iter().map(|&rung| self.candidate(object, rung));
            Ok(Seat { material: self.material[object], candidates: candidates.collect::<Result<_, PlanError>>()? })
        };
        found.iter().enumerate().map(seat).collect()
    }

    /// Times models, given as object and rung.
    pub(super) fn time(&self, keys: &[(usize, usize)]) -> Result<(), PlanError> {
        let model = |&(object, rung): &(usize, usize)| self.models.get(self.material[object], rung);
        let models = keys.iter().map(|key| Ok((*key, model(key)?))).collect::<Result<Vec<_>, PlanError>>()?;
        let models: Vec<_> = models.iter().map(|(key, model)| (*key, model.brdf.as_ref())).collect();
        self.bench.measure(&models, self.view().demands());
        Ok(())
    }

    /// Takes over how long another one's models have taken, so that two plans differ in nothing but what they tried.
    pub fn learn_times(&self, other: &Self) {
        self.bench.learn(&other.bench);
    }

    pub(super) fn chosen_models(&self, chosen: &[usize]) -> Result<Vec<Arc<Model>>, PlanError> {
        let own = self.material.iter().zip(chosen).map(|(&material, &rung)| Ok(self.models.get(material, rung)?));
        own.collect()
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
