//! Published networks: Keras `.h5` files, three Dense layers each, read and written.
//!
//! Only the weights are read. The `.json` published beside a `.h5` carries marshalled Python bytecode; nothing here
//! opens it. Layer names carry numbers that vary (`dense_1`, `dense_4`, ...): layers are found by their contents,
//! wherever they are, and ordered by number.

mod write;

use hdf5_pure::{DType, Dataset, Error, File, Group, Layout, is_hdf5_bytes};

use super::{
    Nbrdf, NbrdfError,
    shape::{ShapeError, hidden_from_shapes},
};

pub use write::{write_architecture, write_keras};

/// Groups looked into and how deep: a published file has 7 groups, 2 deep.
const MAX_GROUPS: usize = 256;
const MAX_DEPTH: usize = 8;

/// Why bytes are not a Keras file of a network.
#[derive(Debug, thiserror::Error)]
pub enum KerasError {
    /// The signature is missing.
    #[error("not an HDF5 file (expected its signature, found other bytes): is it a Keras .h5?")]
    NotHdf5,
    /// The file's structure cannot be followed.
    #[error("damaged HDF5 file ({0}): fetch it again")]
    Damaged(String),
    /// Not three Dense layers.
    #[error("expected 3 Dense layers (kernel and bias each), found {}: [{}]", found.len(), found.join(", "))]
    Layers {
        /// Names of the layers found, in order.
        found: Vec<String>,
    },
    /// An array is not stored as plain 32- or 64-bit floats.
    #[error("array {array} is stored as {found}, expected uncompressed f32 or f64: save the weights again")]
    Storage {
        /// Path of the array.
        array: String,
        /// Its type or layout.
        found: String,
    },
    /// An array has the wrong shape.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// The numbers are not a network.
    #[error(transparent)]
    Network(#[from] NbrdfError),
}

impl From<Error> for KerasError {
    fn from(error: Error) -> Self {
        Self::Damaged(error.to_string())
    }
}

/// A Dense layer as found in the file.
struct Dense {
    number: u64,
    name: String,
    kernel: Dataset,
    bias: Dataset,
}

/// Reads a network from the bytes of a Keras `.h5` file.
///
/// # Errors
/// [`KerasError`] if the bytes are no HDF5 file or a damaged one, if there are not exactly three Dense layers of
/// consistent shapes (6, n) (n, m) (m, 3), or if a weight is NaN or infinite.
pub fn read_keras(bytes: &[u8]) -> Result<Nbrdf, KerasError> {
    if !is_hdf5_bytes(bytes) {
        return Err(KerasError::NotHdf5);
    }
    let file = File::from_bytes(bytes.to_vec())?;
    let mut layers = Vec::new();
    collect(&file.root(), "", 0, &mut 0, &mut layers)?;
    layers.sort_by(|a, b| (a.number, &a.name).cmp(&(b.number, &b.name)));
    let Ok([first, second, third]) = <&[Dense; 3]>::try_from(layers.as_slice()) else {
        return Err(KerasError::Layers { found: layers.into_iter().map(|layer| layer.name).collect() });
    };
    let arrays = [first, second, third].map(|layer| {
        [(format!("{}/kernel", layer.name), &layer.kernel), (format!("{}/bias", layer.name), &layer.bias)]
    });
    let [[a, b], [c, d], [e, f]] = arrays;
    read_arrays([a, b, c, d, e, f])
}

/// Shapes first: what does not fit is refused before its numbers are read.
fn read_arrays(arrays: [(String, &Dataset); 6]) -> Result<Nbrdf, KerasError> {
    let mut shapes: [(String, Vec<u64>); 6] = Default::default();
    for ((name, dataset), shape) in arrays.iter().zip(&mut shapes) {
        *shape = (name.clone(), dataset.shape()?);
    }
    let hidden = hidden_from_shapes(&shapes)?;
    let mut weights = Vec::with_capacity(super::weight_count(hidden));
    for (name, dataset) in arrays {
        weights.extend(values(name, dataset)?);
    }
    Ok(Nbrdf::new(hidden, weights)?)
}

fn values(array: String, dataset: &Dataset) -> Result<Vec<f32>, KerasError> {
    // Compressed chunks may unpack to any size; Keras writes plain arrays.
    match dataset.layout()? {
        Layout::Contiguous { address: Some(_), .. } | Layout::Compact { .. } => {}
        Layout::Contiguous { address: None, .. } => {
            return Err(KerasError::Storage { array, found: "a reserved place without numbers".to_owned() });
        }
        _ => return Err(KerasError::Storage { array, found: "chunks or references".to_owned() }),
    }
    match dataset.dtype()? {
        DType::F32 => Ok(dataset.read_f32()?),
        DType::F64 => Ok(dataset.read_f64()?.into_iter().map(|value| value as f32).collect()),
        other => Err(KerasError::Storage { array, found: other.to_string() }),
    }
}

/// Finds every group that holds a kernel and a bias, below `group`.
fn collect(
    group: &Group,
    path: &str,
    depth: usize,
    seen: &mut usize,
    layers: &mut Vec<Dense>,
) -> Result<(), KerasError> {
    *seen += 1;
    if *seen > MAX_GROUPS || depth > MAX_DEPTH {
        let limit = format!("more than {MAX_GROUPS} groups, or deeper than {MAX_DEPTH}");
        return Err(KerasError::Damaged(limit));
    }
    let (mut kernel, mut bias) = (None, None);
    for (name, dataset) in group.iter_datasets()? {
        match name.as_str() {
            "kernel:0" | "kernel" => kernel = Some(dataset),
            "bias:0" | "bias" => bias = Some(dataset),
            _ => {}
        }
    }
    if let (Some(kernel), Some(bias)) = (kernel, bias) {
        layers.push(Dense { number: trailing_number(path), name: path.to_owned(), kernel, bias });
    }
    for (name, child) in group.iter_groups()? {
        // A whole saved model also holds the optimizer's averages, shaped like the weights.
        if name != "optimizer_weights" {
            let path = if path.is_empty() { name } else { format!("{path}/{name}") };
            collect(&child, &path, depth + 1, seen, layers)?;
        }
    }
    Ok(())
}

/// `dense_12` is 12; `dense`, Keras' name for the first, is 0.
fn trailing_number(path: &str) -> u64 {
    let digits = path.trim_end_matches(|c: char| c.is_ascii_digit());
    path.get(digits.len()..).and_then(|number| number.parse().ok()).unwrap_or(0)
}

#[cfg(test)]
mod tests;
