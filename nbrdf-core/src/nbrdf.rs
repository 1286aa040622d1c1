//! NBRDF: one small network per material.
//!
//! A. Sztrajman, G. Rainer, T. Ritschel, T. Weyrich, *Neural BRDF Representation and Importance Sampling* (2021),
//! doi 10.1111/cgf.14335, section 3: f = exp(W₃ relu(W₂ relu(W₁ (h, d) + b₁) + b₂) + b₃) − 1, 6-21-21-3.
//! Differs from the paper: the result is clamped at 0 on evaluation, y is capped so that `exp` stays finite.

pub mod anisotropic;
mod compact;
pub mod corridor;
pub mod file;
pub mod fit;
pub mod gradient;
pub mod keras;
pub(crate) mod kernel;
pub mod npy;
pub mod objective;
pub mod precision;
mod prune;
pub mod safetensors;
pub mod samples;
mod shape;
mod shrink;
pub mod symmetry;
pub(crate) mod tangent;

use std::any::Any;
use std::ops::Range;

use crate::brdf::{Azimuth, Prepared};
use crate::simd::InstructionSet;
use crate::{Brdf, Directions, Rgb};
use kernel::{Packed, Sign};

pub use kernel::Live;
pub use shape::{ARRAYS, ShapeError};

/// Inputs of the network: h.x h.y h.z d.x d.y d.z.
pub const INPUTS: usize = 6;
/// Hidden widths of the published networks.
pub const PUBLISHED_HIDDEN: [usize; 2] = [21, 21];
/// Numbers in a published network.
pub const PUBLISHED_WEIGHTS: usize = weight_count(PUBLISHED_HIDDEN);
/// Largest hidden width read from a file.
pub const MAX_HIDDEN: usize = 256;

/// Numbers in a network of these hidden widths: 675 for (21, 21).
pub const fn weight_count(hidden: [usize; 2]) -> usize {
    INPUTS * hidden[0] + hidden[0] + hidden[0] * hidden[1] + hidden[1] + hidden[1] * 3 + 3
}

/// A network and its hidden widths; always finite, always of the right length.
#[derive(Clone, Debug)]
pub struct Nbrdf {
    hidden: [usize; 2],
    weights: Vec<f32>,
    /// The weights again, in the order of the kernel.
    packed: Packed,
}

/// Networks are equal when their weights are, however they are evaluated.
impl PartialEq for Nbrdf {
    fn eq(&self, other: &Self) -> bool {
        self.hidden == other.hidden && self.weights == other.weights
    }
}

/// Why numbers are not a network.
#[derive(Debug, thiserror::Error, PartialEq)]
pub enum NbrdfError {
    /// Wrong number of weights for the hidden widths.
    #[error("a {}-{}-{}-3 network has {expected} weights, found {found}", INPUTS, hidden[0], hidden[1])]
    Length {
        /// Hidden widths asked for.
        hidden: [usize; 2],
        /// Weights they need.
        expected: usize,
        /// Weights given.
        found: usize,
    },
    /// A weight is NaN or infinite.
    #[error("weight {index} is {value}, expected a finite number")]
    NotFinite {
        /// Its place in the flattened weights.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// A hidden width is zero or beyond [`MAX_HIDDEN`].
    #[error("hidden widths {hidden:?} are not between 1 and {MAX_HIDDEN}")]
    Width {
        /// Hidden widths asked for.
        hidden: [usize; 2],
    },
}

/// Where each array lies in the flattened weights: kernel `(in, out)` row-major, then bias, layer by layer.
#[derive(Clone, Debug)]
pub struct Layout {
    /// Kernel and bias of the three layers.
    pub layers: [(Range<usize>, Range<usize>); 3],
}

impl Layout {
    /// For these hidden widths.
    pub fn new([first, second]: [usize; 2]) -> Self {
        let mut start = 0;
        let layers = [(INPUTS, first), (first, second), (second, 3)].map(|(rows, columns)| {
            let kernel = start..start + rows * columns;
            let bias = kernel.end..kernel.end + columns;
            start = bias.end;
            (kernel, bias)
        });
        Self { layers }
    }
}

impl Nbrdf {
    /// A network of the published shape from its 675 flattened weights.
    pub fn published(weights: Vec<f32>) -> Result<Self, NbrdfError> {
        Self::new(PUBLISHED_HIDDEN, weights)
    }

    /// A network of any hidden widths from its flattened weights.
    pub fn new(hidden: [usize; 2], weights: Vec<f32>) -> Result<Self, NbrdfError> {
        if hidden.iter().any(|&width| width == 0 || width > MAX_HIDDEN) {
            return Err(NbrdfError::Width { hidden });
        }
        let expected = weight_count(hidden);
        if weights.len() != expected {
            return Err(NbrdfError::Length { hidden, expected, found: weights.len() });
        }
        all_finite(&weights)?;
        Ok(Self::of_valid(hidden, weights))
    }

    /// Changes all weights and keeps the shape; allocates nothing, unless the
    /// network was pruned. On an error the network stays as it was.
    ///
    /// # Panics
    /// If there are not as many weights as before (a bug of the caller).
    pub fn set_weights(&mut self, weights: &[f32]) -> Result<(), NbrdfError> {
        all_finite(weights)?;
        self.weights.copy_from_slice(weights);
        // What could not fire before may fire now.
        if self.packed.live().is_all(self.hidden) {
            self.packed.refill(self.hidden, weights);
        } else {
            self.packed = Packed::new(self.hidden, weights, Live::all(self.hidden));
        }
        Ok(())
    }

    /// From weights known to be valid.
    fn of_valid(hidden: [usize; 2], weights: Vec<f32>) -> Self {
        let packed = Packed::new(hidden, &weights, Live::all(hidden));
        Self { hidden, weights, packed }
    }

    /// Hidden widths.
    pub const fn hidden(&self) -> [usize; 2] {
        self.hidden
    }

    /// Flattened weights.
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// The weights, moved out.
    pub fn into_weights(self) -> Vec<f32> {
        self.weights
    }

    /// Puts a network where a reflectance was; allocates nothing where that was a network of the same shape. On an error
    /// `place` stays as it was.
    pub fn put(hidden: [usize; 2], weights: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), NbrdfError> {
        let old: &mut dyn Any = place.as_mut();
        match old.downcast_mut::<Self>() {
            Some(network) if network.hidden == hidden && network.weights.len() == weights.len() => {
                network.set_weights(weights)
            }
            _ => {
                *place = Box::new(Self::new(hidden, weights.to_vec())?);
                Ok(())
            }
        }
    }

    /// f_r as [`eval_into`](Brdf::eval_into) gives it, with vectors of a given kind: for comparing them.
    ///
    /// # Panics
    /// If `at` and `out` differ in length (a bug of the caller).
    pub fn eval_with(&self, set: InstructionSet, at: &[Directions], out: &mut [Rgb]) {
        kernel::forward(set, &self.packed, Sign::Clamped, (at, Azimuth::Dropped), out);
    }

    /// As [`eval_with`](Self::eval_with), from prepared pairs: the network alone.
    ///
    /// # Panics
    /// If `at` and `out` differ in length (a bug of the caller).
    pub fn eval_prepared_with(&self, set: InstructionSet, at: &Prepared, out: &mut [Rgb]) {
        match at.azimuth() {
            Azimuth::Dropped => kernel::forward_blocks(set, &self.packed, Sign::Clamped, at.blocks(), out),
            Azimuth::Kept => self.eval_with(set, at.directions(), out),
        }
    }

    /// Where each array lies in [`weights`](Self::weights).
    pub fn layout(&self) -> Layout {
        Layout::new(self.hidden)
    }
}

impl Brdf for Nbrdf {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_into(&[at], &mut out);
        out[0]
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.eval_with(InstructionSet::fastest(), at, out);
    }

    fn eval_prepared(&self, at: &Prepared, out: &mut [Rgb]) {
        self.eval_prepared_with(InstructionSet::fastest(), at, out);
    }

    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        kernel::forward(InstructionSet::fastest(), &self.packed, Sign::Kept, (at, Azimuth::Dropped), out);
    }
}

fn all_finite(weights: &[f32]) -> Result<(), NbrdfError> {
    match weights.iter().enumerate().find(|(_, w)| !w.is_finite()) {
        Some((index, &value)) => Err(NbrdfError::NotFinite { index, value }),
        None => Ok(()),
    }
}
