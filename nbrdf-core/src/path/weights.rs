//! Barycentric weights: one per end, sum 1.

use smallvec::{SmallVec, smallvec};

use super::PathError;

/// Weights of the ends of a path; negative ones lie beyond the ends. Up to six are no allocation.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(SmallVec<[f32; 6]>);

/// Why numbers are not barycentric weights.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("weights {found:?} do not add up to a positive, finite sum")]
pub struct WeightsError {
    /// The numbers given.
    pub found: Vec<f32>,
}

impl Weights {
    /// (1 − t, t): t = 0 is the first of two ends, t = 1 the second.
    pub fn two(t: f32) -> Self {
        Self(smallvec![1.0 - t, t])
    }

    /// Any weights, scaled to the sum 1.
    pub fn normalized(weights: Vec<f32>) -> Result<Self, WeightsError> {
        let sum: f32 = weights.iter().sum();
        if !(sum.is_finite() && sum > 0.0) {
            return Err(WeightsError { found: weights });
        }
        Ok(Self(weights.into_iter().map(|w| w / sum).collect()))
    }

    /// The numbers.
    pub fn as_slice(&self) -> &[f32] {
        &self.0
    }

    /// The numbers, if there are as many as ends.
    pub fn for_ends(&self, ends: usize) -> Result<&[f32], PathError> {
        if self.0.len() == ends { Ok(&self.0) } else { Err(PathError::Weights { ends, weights: self.0.len() }) }
    }
}
