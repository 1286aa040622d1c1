//! Ways to store a material as a few numbers, and to get it back.

pub mod analytic;
pub mod basis;
pub mod charting;
mod code;
pub mod factored_microfacet;
pub mod grid;
pub mod linear_combination;
pub mod log_table;
pub mod measured_tables;
pub mod network;
pub mod optimal_sampling;
pub mod pca;
pub mod pca_tables;
pub mod pca_weights;
pub mod refined;
pub mod span;
pub mod table;
pub(crate) mod value_table;
pub mod values;

pub use code::{Code, check_numbers};

use crate::nbrdf::precision::Precision;
use crate::{Brdf, Material, Nbrdf};

/// A way to store a material as `dim` numbers, and to get it back.
///
/// Contract: `encode` is deterministic and gives a code of `dim` finite numbers that `decode` takes; `decode` refuses
/// codes of another representation, of another checkpoint, of the wrong length, or not finite.
pub trait Representation: Send + Sync {
    /// Name in the catalog and in codes.
    fn name(&self) -> &'static str;

    /// Numbers in a code.
    fn dim(&self) -> usize;

    /// Hash of what was learned (basis, network); codes carry it, so that they are never read with another one.
    fn checkpoint(&self) -> &str;

    /// Bytes that are kept of a material at most: a code of single precision, unless a representation says otherwise.
    fn code_bytes(&self) -> usize {
        size_of::<f32>() * self.dim()
    }

    /// Bits of stored weights, where codes are the weights of networks.
    fn precision(&self) -> Precision {
        Precision::Single
    }

    /// Bytes that are kept of this material: the same of all, unless a representation says otherwise.
    fn bytes_of(&self, _code: &Code) -> usize {
        self.code_bytes()
    }

    /// Bytes that decoding reads beside the code, the same for all materials: basis, decoder.
    fn shared_bytes(&self) -> usize;

    /// The numbers that stand for a material.
    fn encode(&self, target: &Material) -> Result<Code, EncodeError>;

    /// The reflectance that a code stands for.
    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError>;

    /// The network that a code stands for; none where codes decode to something else (tables, formulas).
    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        code.checked(self.name(), self.checkpoint(), self.dim()).map(|_| None)
    }

    /// As [`decode`](Self::decode) of plain numbers, in place of an earlier reflectance: representations that decode to
    /// networks allocate nothing. On an error `place` stays as it was.
    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        *place = self.decode(&self.code(numbers.to_vec()))?;
        Ok(())
    }

    /// The network of these numbers and its derivatives, where codes decode to networks smoothly.
    fn linearize(&self, _numbers: &[f32]) -> Result<Option<Linearized>, DecodeError> {
        Ok(None)
    }

    /// A code of this representation from plain numbers.
    fn code(&self, numbers: Vec<f32>) -> Code {
        Code::new(self.name(), self.checkpoint(), numbers)
    }
}

/// A network and how its weights move with the numbers of its code.
#[derive(Clone, Debug, PartialEq)]
pub struct Linearized {
    /// Hidden widths.
    pub hidden: [usize; 2],
    /// Flattened weights.
    pub weights: Vec<f32>,
    /// ∂weights/∂number \[numbers, weights\].
    pub by_number: Vec<f32>,
}

impl Linearized {
    /// ∂weights/∂number, number by number.
    pub fn rows(&self) -> impl Iterator<Item = &[f32]> {
        self.by_number.chunks_exact(self.weights.len())
    }

    /// ∂loss/∂number from ∂loss/∂weight.
    ///
    /// # Panics
    /// If there is not one derivative per weight (a bug of the caller).
    pub fn pull_back(&self, by_weight: &[f32]) -> Vec<f32> {
        assert_eq!(by_weight.len(), self.weights.len(), "one derivative per weight");
        let dot = |row: &[f32]| row.iter().zip(by_weight).map(|(a, b)| f64::from(a * b)).sum::<f64>() as f32;
        self.rows().map(dot).collect()
    }
}

impl<R: Representation + ?Sized> Representation for std::sync::Arc<R> {
    fn name(&self) -> &'static str {
        (**self).name()
    }

    fn dim(&self) -> usize {
        (**self).dim()
    }

    fn checkpoint(&self) -> &str {
        (**self).checkpoint()
    }

    fn code_bytes(&self) -> usize {
        (**self).code_bytes()
    }

    fn precision(&self) -> Precision {
        (**self).precision()
    }

    fn bytes_of(&self, code: &Code) -> usize {
        (**self).bytes_of(code)
    }

    fn shared_bytes(&self) -> usize {
        (**self).shared_bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        (**self).encode(target)
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        (**self).decode(code)
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        (**self).network(code)
    }

    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        (**self).decode_into(numbers, place)
    }

    fn linearize(&self, numbers: &[f32]) -> Result<Option<Linearized>, DecodeError> {
        (**self).linearize(numbers)
    }
}

/// Why a material has no code.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// The representation reads weights, and the material has none.
    #[error("{model} encodes networks, and '{material}' has none: fit one first")]
    NeedsNetwork {
        /// The representation.
        model: &'static str,
        /// The material.
        material: String,
    },
    /// The network has another shape than those the representation was learned from.
    #[error("{model} takes networks of hidden widths {expected:?}, '{material}' has {found:?}: fit it again")]
    Shape {
        /// The representation.
        model: &'static str,
        /// The material.
        material: String,
        /// Hidden widths expected.
        expected: [usize; 2],
        /// Hidden widths found.
        found: [usize; 2],
    },
    /// The material evaluates to NaN or infinity.
    #[error("'{material}' gives values that are not finite")]
    NotFinite {
        /// The material.
        material: String,
    },
    /// The representation's own code could not be decoded.
    #[error(transparent)]
    Decode(#[from] DecodeError),
}

/// Why numbers are not a code of this representation.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// Made by another representation.
    #[error("the code was made by '{found}', this is '{expected}': decode it with --with {found}")]
    Model {
        /// This representation.
        expected: String,
        /// The code's.
        found: String,
    },
    /// Made with another checkpoint.
    #[error("the code was made with checkpoint {found}, this is {expected}: use that checkpoint, or encode again")]
    Checkpoint {
        /// This checkpoint.
        expected: String,
        /// The code's.
        found: String,
    },
    /// Wrong number of numbers.
    #[error("a code of {model} has {expected} numbers, found {found}")]
    Length {
        /// The representation.
        model: String,
        /// Numbers expected.
        expected: usize,
        /// Numbers found.
        found: usize,
    },
    /// A number is NaN or infinite.
    #[error("number {index} of the code is {value}, expected a finite number")]
    NotFinite {
        /// Its place.
        index: usize,
        /// Its value.
        value: f32,
    },
    /// The representation failed on a valid code.
    #[error("{0}")]
    Failed(String),
}
