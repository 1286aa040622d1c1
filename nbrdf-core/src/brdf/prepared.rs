//! Pairs of directions together with what networks read of them: for many materials at the same places.

use crate::Directions;
use crate::nbrdf::kernel::{self, Block};

/// What networks read of how a pair is turned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Azimuth {
    /// Nothing: h = (sin θ_half, 0, cos θ_half), for isotropic materials.
    #[default]
    Dropped,
    /// φ_half: h as it is, for anisotropic ones.
    Kept,
}

/// Pairs of directions, converted once.
#[derive(Clone, Debug, Default)]
pub struct Prepared {
    directions: Vec<Directions>,
    blocks: Vec<Block>,
    azimuth: Azimuth,
}

impl Prepared {
    /// Converts the pairs; those below the surface stay, and are black.
    pub fn new(directions: Vec<Directions>) -> Self {
        Self::converted(directions, Azimuth::Dropped)
    }

    /// As [`new`](Self::new), for networks of materials that change when they are turned.
    pub fn keeping_azimuth(directions: Vec<Directions>) -> Self {
        Self::converted(directions, Azimuth::Kept)
    }

    fn converted(directions: Vec<Directions>, azimuth: Azimuth) -> Self {
        Self { blocks: kernel::blocks(&directions, azimuth), directions, azimuth }
    }

    /// What networks read of how these pairs are turned.
    pub const fn azimuth(&self) -> Azimuth {
        self.azimuth
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
