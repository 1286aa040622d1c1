//! The parameters that come closest: several starts of the core, then the parts that help, one by one, then all together.
//!
//! Least squares by Levenberg–Marquardt on what the project judges by: log_error, relative_log and displayed sphere
//! pixels ([`Objective::REFINE`]). Parameters are fitted as logits of their places in their ranges. Deterministic.

use std::convert::Infallible;
use std::marker::PhantomData;

use rayon::prelude::*;

use super::starts::starts;
use super::{FitErrors, Parameter, ShadingModel};
use crate::Brdf;
use crate::least_squares::{Residuals, Steps, minimize};
use crate::nbrdf::fit::generator;
use crate::nbrdf::objective::{Objective, features};
use crate::nbrdf::samples::{SampleCounts, Samples};
use crate::representation::analytic::Target;
use crate::representation::analytic::number::{between, of_between};

/// Seed of the directions.
const SEED: u64 = 94;
/// Directions and pixels that are compared.
const COUNTS: SampleCounts = SampleCounts { log: 1024, relative: 1024, pixels: 320, lamps: 4 };
/// Steps from every start, for every part, and at the end.
const TRIED: usize = 10;
const REFINED: usize = 40;
/// Offset of numerical derivatives, relative to the numbers' size.
const OFFSET: f32 = 1e-3;
/// A part is used if it lowers the loss by this share, and by this much.
const WORTH: f64 = 0.01;
const SEEN: f64 = 3e-4;
/// A parameter this near an end of its range, as a share of it, is put there if that costs less than a thousandth.
const NEAR: f32 = 0.01;

/// A shading model fitted to a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted<M> {
    /// The model, as it is written to files.
    pub model: M,
    /// Parts beyond the core that it uses, in the order of the parameters.
    pub parts: Vec<&'static str>,
    /// How far it is from the material.
    pub errors: FitErrors,
}

/// Fits a model; none to what is not finite. Takes a fraction of a second. What changes when it is turned is fitted as it
/// is at azimuth 0.
pub fn fit<M: ShadingModel>(material: &dyn Brdf) -> Option<Fitted<M>> {
    let seen = Target::of(material)?;
    let samples = Samples::random(&mut generator(SEED, 0), COUNTS);
    let target = features(&samples, &samples.values(material));
    if target.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let search = Search::<M> { samples, target, model: PhantomData };
    let core = search.slots(&[""]);
    let begun = starts::<M>(&seen).into_par_iter().map(|start| search.walk(&start, &core, TRIED));
    let mut best = lowest(begun.collect())?;
    best = search.walk(&best.values, &core, REFINED);
    let mut parts = vec![""];
    while let Some((found, part)) = search.helpful(&best, &parts) {
        best = found;
        parts.push(part);
    }
    best = search.walk(&best.values, &search.slots(&parts), REFINED);
    let model = M::from_values(&search.tidied(best, &parts));
    let used = |part: &&'static str| parts.contains(part) && !part.is_empty();
    let mut parts: Vec<_> = M::PARAMETERS.iter().map(|parameter| parameter.part).filter(used).collect();
    parts.dedup();
    Some(Fitted { model, parts, errors: FitErrors::of(material, model.brdf().as_ref()) })
}

/// All numbers of a model, and how good they are.
struct Found {
    loss: f64,
    values: Vec<f32>,
}

fn lowest(found: Vec<Found>) -> Option<Found> {
    found.into_iter().min_by(|a, b| a.loss.total_cmp(&b.loss))
}

/// A number that is fitted.
#[derive(Clone, Copy)]
struct Slot {
    place: usize,
    parameter: &'static Parameter,
}

struct Search<M> {
    samples: Samples,
    target: Vec<f32>,
    model: PhantomData<fn() -> M>,
}

impl<M: ShadingModel> Search<M> {
    /// The numbers of these parts.
    fn slots(&self, parts: &[&str]) -> Vec<Slot> {
        let numbers = M::PARAMETERS.iter().flat_map(|parameter| (0..parameter.size).map(move |_| parameter));
        let slots = numbers.enumerate().map(|(place, parameter)| Slot { place, parameter });
        slots.filter(|slot| parts.contains(&slot.parameter.part)).collect()
    }

    /// Downhill from these numbers, of which only the slots move.
    fn walk(&self, from: &[f32], slots: &[Slot], steps: usize) -> Found {
        let problem = Problem { search: self, from, slots };
        let start: Vec<f32> = slots.iter().map(|slot| of_between(from[slot.place], slot.parameter.range)).collect();
        let Ok(end) = minimize(&problem, &start, Steps { steps, offset: OFFSET });
        let values = problem.values(&end);
        Found { loss: self.loss(&values), values }
    }

    /// The part not yet used that lowers the loss most, if any is worth it.
    fn helpful(&self, best: &Found, parts: &[&'static str]) -> Option<(Found, &'static str)> {
        let mut left: Vec<_> = M::PARAMETERS.iter().map(|parameter| parameter.part).collect();
        left.retain(|part| !parts.contains(part));
        left.dedup();
        let tries: Vec<(&'static str, usize)> = left.into_iter().flat_map(|part| [(part, 0), (part, 1)]).collect();
        let attempt = |&(part, which): &(&'static str, usize)| {
            let mut values = best.values.clone();
            for slot in self.slots(&[part]) {
                values[slot.place] = slot.parameter.tried[which];
            }
            (self.walk(&values, &self.slots(&[parts, &[part]].concat()), TRIED), part)
        };
        let found: Vec<_> = tries.par_iter().map(attempt).collect();
        let found = found.into_iter().min_by(|a, b| a.0.loss.total_cmp(&b.0.loss))?;
        (found.0.loss < best.loss * (1.0 - WORTH) - SEEN).then_some(found)
    }

    /// Numbers as people write them: at an end of their range where they are all but there, else of four digits.
    fn tidied(&self, best: Found, parts: &[&str]) -> Vec<f32> {
        let Found { loss, mut values } = best;
        for Slot { place, parameter } in self.slots(parts) {
            let [low, high] = parameter.range;
            let share = (values[place] - low) / (high - low);
            let end = if share < 0.5 { low } else { high };
            let before = values[place];
            if share.min(1.0 - share) < NEAR {
                values[place] = end;
                if self.loss(&values) <= 1.001 * loss {
                    continue;
                }
            }
            values[place] = (before * 1e4).round() / 1e4;
        }
        values
    }

    fn residual(&self, values: &[f32]) -> Vec<f32> {
        let brdf = M::from_values(values).brdf();
        let mut own = features(&self.samples, &self.samples.values(brdf.as_ref()));
        own.iter_mut().zip(&self.target).for_each(|(own, target)| *own -= target);
        own
    }

    fn loss(&self, values: &[f32]) -> f64 {
        loss(&self.samples, &self.residual(values))
    }
}

fn loss(samples: &Samples, residual: &[f32]) -> f64 {
    let zero = vec![0.0; residual.len()];
    Objective::REFINE.loss(samples, residual, &zero, &mut vec![0.0; residual.len()])
}

struct Problem<'a, M> {
    search: &'a Search<M>,
    from: &'a [f32],
    slots: &'a [Slot],
}

impl<M: ShadingModel> Problem<'_, M> {
    /// All numbers of the model, those of the slots from their logits.
    fn values(&self, point: &[f32]) -> Vec<f32> {
        let mut values = self.from.to_vec();
        for (slot, &number) in self.slots.iter().zip(point) {
            values[slot.place] = between(number, slot.parameter.range);
        }
        values
    }
}

impl<M: ShadingModel> Residuals for Problem<'_, M> {
    type Error = Infallible;

    fn residuals(&self, points: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, Infallible> {
        Ok(points.par_iter().map(|point| self.search.residual(&self.values(point))).collect())
    }

    fn weights(&self, residual: &[f32]) -> Vec<f32> {
        Objective::REFINE.squared_weights(&self.search.samples, residual)
    }

    fn loss(&self, residual: &[f32]) -> f64 {
        loss(&self.search.samples, residual)
    }
}
