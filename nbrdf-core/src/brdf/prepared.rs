//! Pairs of directions together with what networks read of them: for many materials at the same places.

use crate::Directions;
use crate::nbrdf::kernel::{self, Block};

/// Pairs of directions, converted once.
#[derive(Clone, Debug, Default)]
pub struct Prepared {
    directions: Vec<Directions>,
    blocks: Vec<Block>,
}

impl Prepared {
    /// Converts the pairs; those below the surface stay, and are black.
    pub fn new(directions: Vec<Directions>) -> Self {
        Self { blocks: kernel::blocks(&directions), directions }
    }

    /// The pairs.
    pub fn directions(&self) -> &[Directions] {
        &self.directions
    }

    /// Number of pairs.
    pub const fn len(&self) -> usize {
        self.directions.len()
    }

    /// Whether there is no pair.
    pub const fn is_empty(&self) -> bool {
        self.directions.is_empty()
    }

    /// The pairs as network inputs; the last block may not be full.
    pub(crate) fn blocks(&self) -> &[Block] {
        &self.blocks
    }
}
