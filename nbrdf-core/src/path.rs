//! Ways to walk between materials.

pub mod bounded;
pub mod clock;
pub mod code_path;
pub mod even;
pub mod geodesic;
pub mod mix;
pub mod nearest_end;
pub mod weight_path;
mod weights;

use std::cell::Cell;

pub use weights::{Weights, WeightsError};

use crate::representation::{DecodeError, EncodeError};
use crate::{Brdf, Code, Material, Warning};

/// A way to walk between materials; the costly part happens once, in `between`.
///
/// Contract: `between` takes two or more ends; the path at weight 1 of an end is the method's own version of that end;
/// every point is finite and not negative.
pub trait Interpolation: Send + Sync {
    /// Name in the catalog and in reports.
    fn name(&self) -> &'static str;

    /// Prepares the walk.
    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError>;
}

/// A prepared walk.
pub trait Path: Send + Sync {
    /// The material at these barycentric weights, one per end.
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError>;

    /// The code that [`at`](Self::at) decodes, where the path walks through codes.
    fn code(&self, _weights: &Weights) -> Result<Option<Code>, PathError> {
        Ok(None)
    }

    /// What is to be said of the point at these weights.
    fn warnings(&self, weights: &Weights) -> Result<Vec<Warning>, PathError> {
        Ok(weights.warning().into_iter().collect())
    }

    /// As [`at`](Self::at), in place of an earlier point: paths through networks allocate nothing. On an error `point`
    /// stays as it was.
    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        *point = self.at(weights)?;
        Ok(())
    }
}

/// Why there is no path, or no such point on it.
#[derive(Debug, thiserror::Error)]
pub enum PathError {
    /// Fewer than two ends.
    #[error("a path needs at least two materials, found {found}")]
    TooFewEnds {
        /// Ends given.
        found: usize,
    },
    /// Another number of weights than ends.
    #[error("the path has {ends} ends, found {weights} weights")]
    Weights {
        /// Ends of the path.
        ends: usize,
        /// Weights given.
        weights: usize,
    },
    /// Weights that add up to nothing.
    #[error(transparent)]
    NotWeights(#[from] WeightsError),
    /// An end has no code.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A mixed code is no material.
    #[error(transparent)]
    Decode(#[from] DecodeError),
    /// Mixed weights are no network.
    #[error(transparent)]
    Network(#[from] crate::nbrdf::NbrdfError),
}

/// Refuses paths with fewer than two ends.
pub(crate) fn at_least_two(ends: &[Material]) -> Result<(), PathError> {
    if ends.len() < 2 { Err(PathError::TooFewEnds { found: ends.len() }) } else { Ok(()) }
}

thread_local! {
    /// Each thread's mixed numbers.
    static MIXED: Cell<Vec<f32>> = const { Cell::new(Vec::new()) };
}

/// Hands `Σ weight · vector` to `then`; allocates nothing after the first call on a thread.
pub(crate) fn with_weighted_sum<T>(
    weights: &Weights,
    vectors: &[Vec<f32>],
    then: impl FnOnce(&[f32]) -> Result<T, PathError>,
) -> Result<T, PathError> {
    let weights = weights.for_ends(vectors.len())?;
    let mut sum = MIXED.take();
    sum.clear();
    sum.resize(vectors[0].len(), 0.0);
    for (&weight, vector) in weights.iter().zip(vectors) {
        sum.iter_mut().zip(vector).for_each(|(sum, v)| *sum += weight * v);
    }
    let result = then(&sum);
    MIXED.set(sum);
    result
}
