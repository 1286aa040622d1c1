//! Refinement: a representation's own code, then a few Levenberg–Marquardt steps on its numbers against the target.
//!
//! Sees the target itself, so it is always reported apart from the feed-forward code.

use std::sync::Arc;

use rayon::prelude::*;

use super::{Code, DecodeError, EncodeError, Linearized, Representation};
use crate::least_squares::{Residuals, Steps, minimize};
use crate::nbrdf::fit::generator;
use crate::nbrdf::objective::{Objective, features, push_forward};
use crate::nbrdf::samples::{SampleCounts, Samples};
use crate::nbrdf::tangent::{Tangents, tangents};
use crate::{Brdf, Material, Nbrdf, Rgb};

/// Steps; more than eight change nothing that can be seen.
const STEPS: Steps = Steps { steps: 8, offset: 3e-3 };
/// Seed of the directions on which the code is judged: refinement is deterministic.
const SEED: u64 = 32;

/// Another representation whose codes are refined; codes and decoder stay its own.
pub struct Refined<R: ?Sized>(pub Arc<R>);

struct CodeProblem<'a, R: ?Sized> {
    representation: &'a R,
    samples: &'a Samples,
    target: Vec<f32>,
}

impl<R: Representation + ?Sized> Residuals for CodeProblem<'_, R> {
    type Error = DecodeError;

    fn residuals(&self, points: &[Vec<f32>]) -> Result<Vec<Vec<f32>>, DecodeError> {
        let one = |point: &Vec<f32>| {
            let decoded = self.representation.decode(&self.representation.code(point.clone()))?;
            let mut own = features(self.samples, &self.samples.values(decoded.as_ref()));
            own.iter_mut().zip(&self.target).for_each(|(own, target)| *own -= target);
            Ok(own)
        };
        points.par_iter().map(one).collect()
    }

    fn jacobian(&self, point: &[f32]) -> Result<Option<Vec<Vec<f32>>>, DecodeError> {
        let Some(linearized) = self.representation.linearize(point)? else { return Ok(None) };
        let changes: Vec<&[f32]> = linearized.rows().collect();
        let Tangents { mut values, derivatives } =
            tangents(linearized.hidden, &linearized.weights, &changes, &self.samples.at);
        values.iter_mut().for_each(|f| *f = f.map(|f| f.max(0.0)));
        let own = features(self.samples, &values);
        let column = |moved: &Vec<Rgb>| {
            let mut column = vec![0.0; own.len()];
            push_forward(self.samples, &values, &own, moved, &mut column);
            column
        };
        Ok(Some(derivatives.par_iter().map(column).collect()))
    }

    fn weights(&self, residual: &[f32]) -> Vec<f32> {
        Objective::REFINE.squared_weights(self.samples, residual)
    }

    fn loss(&self, residual: &[f32]) -> f64 {
        let zero = vec![0.0; residual.len()];
        Objective::REFINE.loss(self.samples, residual, &zero, &mut vec![0.0; residual.len()])
    }
}

/// Refines `start` against `target`; the loss never rises.
pub fn refine<R: Representation + ?Sized>(
    representation: &R,
    start: &Code,
    target: &dyn Brdf,
) -> Result<Code, EncodeError> {
    let numbers = start.checked(representation.name(), representation.checkpoint(), representation.dim())?;
    let samples = Samples::random(&mut generator(SEED, 2), SampleCounts::REFINE);
    let target = features(&samples, &samples.values(target));
    let problem = CodeProblem { representation, samples: &samples, target };
    let refined = minimize(&problem, numbers, STEPS)?;
    Ok(Code { code: refined, ..start.clone() })
}

impl<R: Representation + ?Sized> Representation for Refined<R> {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn dim(&self) -> usize {
        self.0.dim()
    }

    fn checkpoint(&self) -> &str {
        self.0.checkpoint()
    }

    fn shared_bytes(&self) -> usize {
        self.0.shared_bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        refine(self.0.as_ref(), &self.0.encode(target)?, target.brdf.as_ref())
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        self.0.decode(code)
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.0.network(code)
    }

    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        self.0.decode_into(numbers, place)
    }

    fn linearize(&self, numbers: &[f32]) -> Result<Option<Linearized>, DecodeError> {
        self.0.linearize(numbers)
    }
}
