//! Refinement: a representation's own code, then Levenberg–Marquardt steps on its numbers against the target.
//!
//! Briefly, as a part of every encoding, or until nothing changes any more. An encoder's own code is a guess at the end
//! of this descent; a few unrolled steps take most of the way that is left (J. Marino et al., *Iterative Amortized
//! Inference* (2018)).

use std::sync::Arc;

use rayon::prelude::*;

use super::{Code, DecodeError, EncodeError, Linearized, Representation};
use crate::least_squares::{Residuals, Steps, minimize};
use crate::nbrdf::fit::generator;
use crate::nbrdf::objective::{Objective, features, push_forward};
use crate::nbrdf::samples::{SampleCounts, Samples};
use crate::nbrdf::tangent::{Tangents, tangents};
use crate::{Brdf, Material, Nbrdf, Rgb};

/// Seed of the directions on which the code is judged: refinement is deterministic.
const SEED: u64 = 32;
/// Offset of numerical derivatives.
const OFFSET: f32 = 3e-3;

/// How long to refine, and on how many samples. Both are fixed, and so is the result.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Steps at most.
    pub steps: usize,
    /// Where the code is judged.
    pub counts: SampleCounts,
}

impl Effort {
    /// A part of encoding: milliseconds.
    pub const BRIEF: Self = Self { steps: 3, counts: SampleCounts { log: 512, relative: 384, pixels: 160, lamps: 4 } };
    /// More steps or samples change nothing that can be seen.
    pub const WHOLE: Self = Self { steps: 8, counts: SampleCounts::REFINE };
}

/// Another representation whose codes are refined; codes and decoder stay its own.
pub struct Refined<R: ?Sized> {
    inner: Arc<R>,
    effort: Effort,
}

impl<R: Representation + ?Sized> Refined<R> {
    /// With as much effort as helps.
    pub const fn new(inner: Arc<R>) -> Self {
        Self { inner, effort: Effort::WHOLE }
    }

    /// With a few steps that are a part of encoding.
    pub const fn briefly(inner: Arc<R>) -> Self {
        Self { inner, effort: Effort::BRIEF }
    }
}

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
    effort: Effort,
) -> Result<Code, EncodeError> {
    let numbers = start.checked(representation.name(), representation.checkpoint(), representation.dim())?;
    let samples = Samples::random(&mut generator(SEED, 2), effort.counts);
    let target = features(&samples, &samples.values(target));
    let problem = CodeProblem { representation, samples: &samples, target };
    let refined = minimize(&problem, numbers, Steps { steps: effort.steps, offset: OFFSET })?;
    // What was expected of the start says nothing of this code.
    Ok(Code { material: start.material.clone(), ..Code::new(&start.model, &start.checkpoint, refined) })
}

impl<R: Representation + ?Sized> Representation for Refined<R> {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn dim(&self) -> usize {
        self.inner.dim()
    }

    fn checkpoint(&self) -> &str {
        self.inner.checkpoint()
    }

    fn code_bytes(&self) -> usize {
        self.inner.code_bytes()
    }

    fn bytes_of(&self, code: &Code) -> usize {
        self.inner.bytes_of(code)
    }

    fn shared_bytes(&self) -> usize {
        self.inner.shared_bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        refine(self.inner.as_ref(), &self.inner.encode(target)?, target.brdf.as_ref(), self.effort)
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        self.inner.decode(code)
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.inner.network(code)
    }

    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        self.inner.decode_into(numbers, place)
    }

    fn linearize(&self, numbers: &[f32]) -> Result<Option<Linearized>, DecodeError> {
        self.inner.linearize(numbers)
    }
}
