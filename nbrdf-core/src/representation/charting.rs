//! Charting: a material's place on the manifold of measured ones.
//!
//! M. Brand, *Charting a Manifold* (NIPS 2002): soft neighbourhoods (`kernel`), a local projection in each (`chart`), one
//! affine map per chart so that all agree (`connection`), mappings both ways (`mapping`). W. Matusik et al., *A
//! Data-Driven Reflectance Model* (2003), take it for the manifold of measured BRDFs, with 15 coordinates.
//!
//! Differs from the latter: the data are the log tables of `PROTOCOL`'s PCA-32, in coordinates of the affine span of the
//! training materials, which is exact: no chart ever leaves it.

mod atlas;
mod chart;
mod connection;
pub mod dimension;
pub mod distortion;
mod file;
mod isometry;
mod kernel;
#[cfg(test)]
mod known;
mod mapping;
mod posterior;
mod span;
#[cfg(test)]
mod tests;
mod vector;

use std::sync::Arc;

pub use atlas::{Atlas, Options};
pub use span::Span;

use super::log_table;
use super::{Code, DecodeError, EncodeError, Representation};
use crate::{Brdf, Material};

/// Most coordinates: finding those that keep lengths takes dim⁴ numbers, 134 MB for 64.
pub const MAX_DIM: usize = 64;

/// Why there is no chart.
#[derive(Debug, thiserror::Error)]
pub enum ChartingError {
    /// Too few points, or too short ones.
    #[error(
        "a chart of {dim} dimensions needs more than {dim} + 1 points of {dim} numbers or more, found {points} of {length}"
    )]
    TooFew {
        /// Coordinates asked for.
        dim: usize,
        /// Points given.
        points: usize,
        /// Numbers of a point.
        length: usize,
    },
    /// More coordinates than the equations for keeping lengths can hold.
    #[error("a chart has {MAX_DIM} dimensions at most, found {dim} asked for")]
    TooMany {
        /// Coordinates asked for.
        dim: usize,
    },
    /// Points of different lengths, or NaN or infinity among their numbers.
    #[error("the points of a chart must be finite and equally long")]
    NotFinite,
    /// All points are in one place.
    #[error("all points are in the same place: there is nothing to chart")]
    NoSpread,
    /// Charts share too few points to be connected.
    #[error("the charts share too few points to be connected: take more neighbours")]
    NotConnected,
    /// An eigenproblem did not converge.
    #[error("the charts have no principal axes: are all values finite?")]
    NoConvergence,
}

/// Coordinates in an [`Atlas`] of log tables.
pub struct Charting {
    name: &'static str,
    span: Arc<Span>,
    atlas: Atlas,
    checkpoint: String,
}

impl Charting {
    /// Charts the training materials of a span, under the name that codes carry.
    pub fn learn(name: &'static str, span: Arc<Span>, options: Options) -> Result<Self, ChartingError> {
        let atlas = Atlas::learn(span.training(), options)?;
        let checkpoint = span.checkpoint(options);
        Ok(Self { name, span, atlas, checkpoint })
    }

    /// The space it lies in.
    pub const fn span(&self) -> &Arc<Span> {
        &self.span
    }

    /// The chart itself.
    pub const fn atlas(&self) -> &Atlas {
        &self.atlas
    }
}

impl Representation for Charting {
    fn name(&self) -> &'static str {
        self.name
    }

    fn dim(&self) -> usize {
        self.atlas.dim()
    }

    fn checkpoint(&self) -> &str {
        &self.checkpoint
    }

    fn shared_bytes(&self) -> usize {
        self.span.bytes() + size_of::<f64>() * self.atlas.numbers()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let place = self.span.project(target)?;
        Ok(self.code(self.atlas.forward(&place).into_iter().map(|x| x as f32).collect()))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        let code = code.checked(self.name, &self.checkpoint, self.dim())?;
        let coordinates: Vec<f64> = code.iter().map(|&x| f64::from(x)).collect();
        Ok(Box::new(log_table::table(self.span.reconstruct(&self.atlas.backward(&coordinates)))))
    }
}
