//! Networks as NumPy arrays: six `.npy` files, or one `.npz` that holds the same six.
//!
//! Arrays `fc1 b1 fc2 b2 fc3 b3`: kernels (inputs, outputs), biases (outputs,), f32 or f64 in either byte and axis
//! order; written as little-endian f32 in C order.

mod array;
mod npz;

use super::{
    ARRAYS, Nbrdf, NbrdfError,
    shape::{ShapeError, hidden_from_shapes},
};
use array::Array;

pub use npz::{read_npz, write_npz};

/// Why bytes are not the arrays of a network.
#[derive(Debug, thiserror::Error)]
pub enum NpyError {
    /// Not a NumPy array, or one whose header no network needs.
    #[error("array {array} is no readable .npy ({found}): save it with numpy.save as f32")]
    Header {
        /// Name of the array.
        array: String,
        /// What is wrong with it.
        found: String,
    },
    /// Fewer or more numbers than the shape says.
    #[error("array {array} ends after {found} bytes of numbers, expected {expected}: fetch the file again")]
    Length {
        /// Name of the array.
        array: String,
        /// Bytes its shape needs.
        expected: usize,
        /// Bytes there.
        found: usize,
    },
    /// Arrays that a network needs are not there.
    #[error("arrays [{}] are missing: a network is {}", missing.join(", "), ARRAYS.join(" "))]
    Missing {
        /// Names of the arrays not there.
        missing: Vec<String>,
    },
    /// The `.npz` is no readable zip archive.
    #[error("not a readable .npz ({0}): fetch the file again")]
    Archive(String),
    /// An array has the wrong shape.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The numbers are not a network.
    #[error(transparent)]
    Network(#[from] NbrdfError),
}

/// Reads a network from the bytes of six `.npy` files, in the order of [`ARRAYS`].
///
/// # Errors
/// [`NpyError`] if one is no array of f32 or f64, the shapes disagree, numbers are missing, or one is not finite.
pub fn read_npy(files: [&[u8]; 6]) -> Result<Nbrdf, NpyError> {
    let mut arrays = Vec::with_capacity(6);
    for (name, bytes) in ARRAYS.iter().zip(files) {
        arrays.push(Array::open(name, bytes)?);
    }
    let mut shapes: [(String, Vec<u64>); 6] = Default::default();
    for (array, shape) in arrays.iter().zip(&mut shapes) {
        *shape = (array.name.clone(), array.shape().to_vec());
    }
    let hidden = hidden_from_shapes(&shapes)?;
    let mut weights = Vec::with_capacity(super::weight_count(hidden));
    for array in arrays {
        weights.extend(array.values()?);
    }
    Ok(Nbrdf::new(hidden, weights)?)
}

/// The bytes of six `.npy` files, in the order of [`ARRAYS`].
pub fn write_npy(network: &Nbrdf) -> [Vec<u8>; 6] {
    let layout = network.layout();
    std::array::from_fn(|i| {
        let (kernel, bias) = &layout.layers[i / 2];
        let columns = bias.len();
        if i % 2 == 0 {
            array::bytes(&[kernel.len() / columns, columns], &network.weights()[kernel.clone()])
        } else {
            array::bytes(&[columns], &network.weights()[bias.clone()])
        }
    })
}

#[cfg(test)]
mod tests;
