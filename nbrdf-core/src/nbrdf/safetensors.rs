//! One network as a `.safetensors` file: a tensor `weights` \[n\] of f32, and its hidden widths in the metadata.

use std::collections::HashMap;

use ::safetensors::{Dtype, SafeTensorError, SafeTensors, tensor::TensorView};

use super::anisotropic::AnisotropicNbrdf;
use super::{MAX_HIDDEN, Nbrdf, NbrdfError, PUBLISHED_HIDDEN};

/// Name of the tensor.
const TENSOR: &str = "weights";
/// Name of the tensor of a network that reads the azimuth: readers that know no such networks find none.
const ANISOTROPIC: &str = "anisotropic_weights";
/// Metadata key of the hidden widths, `21,21`.
const HIDDEN: &str = "hidden";

/// Why bytes are not the `.safetensors` file of networks.
#[derive(Debug, thiserror::Error)]
pub enum TensorError {
    /// Not a safetensors file, or a damaged one.
    #[error("not a readable safetensors file ({0}): fetch it again")]
    Damaged(#[from] SafeTensorError),
    /// The tensor of a single network is missing.
    #[error("expected one tensor `weights`, found [{}]: is this a whole library? Then name its folder", found.join(", "))]
    Missing {
        /// Tensors in the file.
        found: Vec<String>,
    },
    /// The network is one that reads the azimuth.
    #[error(
        "expected the network of an isotropic material, found one of a material that changes when it is turned: it can be rendered, but has no code, no paths and no place in a library"
    )]
    Anisotropic,
    /// Two networks, of which nobody knows which is meant.
    #[error("expected one of the tensors `{TENSOR}` and `{ANISOTROPIC}`, found both: write them into two files")]
    Both,
    /// A tensor is not a row of f32.
    #[error("tensor {tensor} is {found}, expected a row of F32")]
    Kind {
        /// Its name.
        tensor: String,
        /// Its type and shape.
        found: String,
    },
    /// The metadata `hidden` is not two widths.
    #[error("metadata `hidden` is {found:?}, expected two widths up to {MAX_HIDDEN} such as \"21,21\"")]
    Hidden {
        /// What it says.
        found: String,
    },
    /// The numbers are not a network.
    #[error("tensor {tensor}: {problem}")]
    Network {
        /// Its name.
        tensor: String,
        /// What is wrong.
        problem: NbrdfError,
    },
}

/// Reads one network: tensor `weights`, hidden widths from the metadata (21, 21 where it has none).
///
/// # Errors
/// [`TensorError`] if the file is damaged, holds other tensors, or the numbers are not a network.
pub fn read_safetensors(bytes: &[u8]) -> Result<Nbrdf, TensorError> {
    let (hidden, tensors) = open(bytes)?;
    let has_azimuth = tensors.tensor(ANISOTROPIC).is_ok();
    match tensors.tensor(TENSOR) {
        Ok(tensor) if !has_azimuth => network(TENSOR, &tensor, hidden),
        Ok(_) => Err(TensorError::Both),
        Err(_) if has_azimuth => Err(TensorError::Anisotropic),
        Err(_) => {
            let mut found: Vec<String> = tensors.names().into_iter().take(8).map(str::to_owned).collect();
            found.sort();
            Err(TensorError::Missing { found })
        }
    }
}

/// The bytes of a `.safetensors` file that [`read_safetensors`] reads.
pub fn write_safetensors(network: &Nbrdf) -> Vec<u8> {
    write_many([(TENSOR, network.weights())], network.hidden())
}

/// Reads one network that reads the azimuth; none where the file holds something else.
///
/// # Errors
/// As [`read_safetensors`].
pub fn read_anisotropic(bytes: &[u8]) -> Result<Option<AnisotropicNbrdf>, TensorError> {
    let (hidden, tensors) = open(bytes)?;
    let Ok(tensor) = tensors.tensor(ANISOTROPIC) else { return Ok(None) };
    if tensors.tensor(TENSOR).is_ok() {
        return Err(TensorError::Both);
    }
    let read = network(ANISOTROPIC, &tensor, hidden)?;
    Ok(Some(AnisotropicNbrdf::of(read)))
}

/// The bytes of a file that [`read_anisotropic`] reads.
pub fn write_anisotropic(network: &AnisotropicNbrdf) -> Vec<u8> {
    write_many([(ANISOTROPIC, network.weights())], network.hidden())
}

/// The tensors of a file and the hidden widths its metadata names.
pub(crate) fn open(bytes: &[u8]) -> Result<([usize; 2], SafeTensors<'_>), TensorError> {
    let (_, header) = SafeTensors::read_metadata(bytes)?;
    let named = header.metadata().as_ref().and_then(|metadata| metadata.get(HIDDEN));
    let hidden = named.map_or(Ok(PUBLISHED_HIDDEN), |text| widths(text))?;
    Ok((hidden, SafeTensors::deserialize(bytes)?))
}

/// The network in one tensor.
pub(crate) fn network(name: &str, tensor: &TensorView<'_>, hidden: [usize; 2]) -> Result<Nbrdf, TensorError> {
    if tensor.dtype() != Dtype::F32 || tensor.shape().len() != 1 {
        let found = format!("{:?} {:?}", tensor.dtype(), tensor.shape());
        return Err(TensorError::Kind { tensor: name.to_owned(), found });
    }
    let weights = tensor.data().as_chunks::<4>().0.iter().map(|&b| f32::from_le_bytes(b)).collect();
    Nbrdf::new(hidden, weights).map_err(|problem| TensorError::Network { tensor: name.to_owned(), problem })
}

/// The bytes of a file of named rows of f32; the same tensors give the same bytes.
pub(crate) fn write_many<'a>(tensors: impl IntoIterator<Item = (&'a str, &'a [f32])>, hidden: [usize; 2]) -> Vec<u8> {
    let rows: Vec<(&str, Vec<u8>)> = tensors
        .into_iter()
        .map(|(name, values)| (name, values.iter().flat_map(|v| v.to_le_bytes()).collect()))
        .collect();
    let views = rows.iter().filter_map(|(name, row)| {
        let view = TensorView::new(Dtype::F32, vec![row.len() / 4], row).ok()?;
        Some((*name, view))
    });
    let metadata = HashMap::from([(HIDDEN.to_owned(), format!("{},{}", hidden[0], hidden[1]))]);
    let written = ::safetensors::serialize(views, Some(metadata));
    debug_assert!(written.is_ok(), "rows of f32 always fit: {written:?}");
    written.unwrap_or_default()
}

fn widths(text: &str) -> Result<[usize; 2], TensorError> {
    let parts: Vec<Option<usize>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match parts.as_slice() {
        [Some(first), Some(second)] if (1..=MAX_HIDDEN).contains(first) && (1..=MAX_HIDDEN).contains(second) => {
            Ok([*first, *second])
        }
        _ => Err(TensorError::Hidden { found: text.to_owned() }),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn sample(hidden: [usize; 2]) -> Nbrdf {
        Nbrdf::new(hidden, (0..crate::nbrdf::weight_count(hidden)).map(|i| i as f32).collect()).unwrap()
    }

    #[test]
    fn a_network_that_reads_the_azimuth_is_told_from_others() {
        let network = AnisotropicNbrdf::of(sample([21, 21]));
        let bytes = write_anisotropic(&network);
        assert_eq!(read_anisotropic(&bytes).unwrap(), Some(network));
        assert!(matches!(read_safetensors(&bytes), Err(TensorError::Anisotropic)));
        assert_eq!(read_anisotropic(&write_safetensors(&sample([21, 21]))).unwrap(), None);
        let weights = sample([21, 21]).into_weights();
        let both = write_many([(TENSOR, weights.as_slice()), (ANISOTROPIC, &weights)], [21, 21]);
        assert!(matches!(read_anisotropic(&both), Err(TensorError::Both)));
        assert!(matches!(read_safetensors(&both), Err(TensorError::Both)));
    }

    #[test]
    fn a_network_written_is_read_back_with_its_widths() {
        for hidden in [[21, 21], [3, 7]] {
            assert_eq!(read_safetensors(&write_safetensors(&sample(hidden))).unwrap(), sample(hidden));
        }
    }

    #[test]
    fn wrong_widths_lengths_and_numbers_are_refused() {
        let bad = write_many([("weights", &[0.0; 674][..])], [21, 21]);
        let error = read_safetensors(&bad).unwrap_err().to_string();
        assert_eq!(error, "tensor weights: a 6-21-21-3 network has 675 weights, found 674");
        let bad = write_many([("weights", &[f32::NAN; 675][..])], [21, 21]);
        assert!(matches!(read_safetensors(&bad), Err(TensorError::Network { .. })));
        let bad = write_many([("weights", &[0.0; 675][..])], [9999, 1]);
        assert!(matches!(read_safetensors(&bad), Err(TensorError::Hidden { .. })));
        let bad = write_many([("chrome", &[0.0; 675][..])], [21, 21]);
        assert!(matches!(read_safetensors(&bad), Err(TensorError::Missing { .. })));
    }

    #[test]
    fn a_file_cut_anywhere_is_an_error() {
        let bytes = write_safetensors(&sample([21, 21]));
        assert!((0..bytes.len()).all(|length| read_safetensors(&bytes[..length]).is_err()));
    }

    proptest! {
        #[test]
        fn garbage_never_panics(length in 0_u64..64, bytes in proptest::collection::vec(any::<u8>(), 0..256)) {
            let _ = read_safetensors(&bytes);
            let framed: Vec<u8> = length.to_le_bytes().into_iter().chain(bytes).collect();
            let _ = read_safetensors(&framed);
        }
    }
}
