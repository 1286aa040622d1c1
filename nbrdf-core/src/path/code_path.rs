//! Straight paths in the code of any representation: latent, PCA, ...

use std::sync::Arc;

use super::{Interpolation, Path, PathError, Weights, at_least_two, with_weighted_sum};
use crate::{Brdf, Code, Material, Representation};

/// Encodes the ends, mixes their codes, decodes.
pub struct CodeInterpolation {
    name: &'static str,
    representation: Arc<dyn Representation>,
}

impl CodeInterpolation {
    /// Under the name that reports use.
    pub fn new(name: &'static str, representation: Arc<dyn Representation>) -> Self {
        Self { name, representation }
    }
}

/// Straight between codes.
pub(super) struct CodePath {
    pub representation: Arc<dyn Representation>,
    pub codes: Vec<Vec<f32>>,
}

impl Interpolation for CodeInterpolation {
    fn name(&self) -> &'static str {
        self.name
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        let codes = codes_of(self.representation.as_ref(), ends)?;
        Ok(Box::new(CodePath { representation: Arc::clone(&self.representation), codes }))
    }
}

/// The codes of two or more ends.
pub(super) fn codes_of(representation: &dyn Representation, ends: &[Material]) -> Result<Vec<Vec<f32>>, PathError> {
    at_least_two(ends)?;
    ends.iter().map(|end| Ok(representation.encode(end)?.code)).collect()
}

impl Path for CodePath {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        with_weighted_sum(weights, &self.codes, |code| {
            Ok(self.representation.decode(&self.representation.code(code.to_vec()))?)
        })
    }

    fn code(&self, weights: &Weights) -> Result<Option<Code>, PathError> {
        with_weighted_sum(weights, &self.codes, |code| Ok(Some(self.representation.code(code.to_vec()))))
    }

    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        with_weighted_sum(weights, &self.codes, |code| Ok(self.representation.decode_into(code, point)?))
    }
}
