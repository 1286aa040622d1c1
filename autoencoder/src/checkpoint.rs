//! Trained autoencoders as files: tensors, with the model's name in the metadata.

use std::path::Path;

use candle_core::{DType, Device, Tensor};
use nbrdf_core::hash;
use nbrdf_core::tensor_file::{Numbers, TensorFile, TensorFileError};

use crate::model::Model;
use crate::parameters::Parameter;
use crate::probe::{PROBES, probe_directions};

/// Largest checkpoint read \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// Why a file is no checkpoint, or could not be written.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The file is no checkpoint, or could not be read or written.
    #[error(transparent)]
    File(#[from] TensorFileError),
    /// The tensor library failed (a bug, or out of memory).
    #[error("tensor library: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// A file's tensors, and what codes call it.
pub(crate) struct Checkpoint {
    pub file: TensorFile,
    /// First 16 hexadecimal digits of the file's SHA-256.
    pub hash: String,
}

impl Checkpoint {
    /// Reads a file.
    pub fn load(path: &Path) -> Result<Self, CheckpointError> {
        Self::parse(&path.display().to_string(), &TensorFile::read(path, MAX_BYTES)?)
    }

    /// Reads bytes that came from `path`, no more than [`MAX_BYTES`].
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self, CheckpointError> {
        let file = match bytes.len() as u64 {
            0..=MAX_BYTES => TensorFile::parse(path, bytes)?,
            _ => return Err(TensorFileError::too_long(path, MAX_BYTES).into()),
        };
        Ok(Self { file, hash: hash::sha256(bytes)[..16].to_owned() })
    }

    /// The tensors of a model under training.
    pub fn of(model: &dyn Model) -> Result<Self, CheckpointError> {
        Ok(Self { file: collect(("model", "training"), &tensors_of(model))?, hash: "untrained".into() })
    }

    /// Trainable numbers: those of the layers.
    pub fn parameters(&self) -> usize {
        let is_layer = |name: &str| name.ends_with(".weight") || name.ends_with(".bias");
        let of_layers = self.file.shapes().filter(|(name, _)| is_layer(name));
        of_layers.map(|(_, shape)| shape.iter().product::<usize>()).sum()
    }

    /// The numbers of a tensor of this shape.
    pub fn tensor(&self, name: &str, shape: &[usize]) -> Result<&[f32], CheckpointError> {
        Ok(self.file.tensor(name, shape)?)
    }

    /// The error of a file that is not what it should be.
    pub fn lacks(&self, expected: impl ToString, found: impl ToString) -> CheckpointError {
        self.file.lacks(expected, found).into()
    }

    /// Puts the file's numbers into a model's trainable tensors.
    pub fn restore(&self, model: &dyn Model) -> Result<(), CheckpointError> {
        for Parameter { name, var, .. } in model.parameters().iter() {
            let values = self.tensor(name, var.dims())?;
            var.set(&Tensor::from_slice(values, var.shape(), &Device::Cpu)?)?;
        }
        Ok(())
    }

    /// Refuses a file whose probes are not those of this software.
    pub fn check_probes(&self) -> Result<(), CheckpointError> {
        let (probes, cosines) = probe_tensors();
        for (name, shape, own) in [("probes", vec![PROBES, 6], probes), ("probe_cosine", vec![PROBES], cosines)] {
            let found = self.tensor(name, &shape)?;
            if own.iter().zip(found).any(|(own, found)| (own - found).abs() > 1e-5) {
                return Err(self.lacks(format!("this version's {name}"), "others"));
            }
        }
        Ok(())
    }
}

/// Network inputs \[192, 6\] and cos θ_i \[192\] of the probes, for programs that read the file.
pub(crate) fn probe_tensors() -> (Vec<f32>, Vec<f32>) {
    let probes = probe_directions();
    let inputs =
        probes.iter().map(|at| at.half_diff()).flat_map(|at| [at.half.to_array(), at.diff.to_array()].concat());
    (inputs.collect(), probes.iter().map(|at| at.light.z).collect())
}

/// All tensors of a model, by name.
pub(crate) fn tensors_of(model: &dyn Model) -> Vec<(String, Tensor)> {
    let trained = model.parameters().iter().map(|own| (own.name.clone(), own.var.as_tensor().clone()));
    let constants = model.constants().into_iter().map(|(name, tensor)| (name.to_owned(), tensor.clone()));
    trained.chain(constants).collect()
}

/// Writes tensors and one pair of metadata; the same ones give the same bytes.
pub(crate) fn save(path: &Path, tensors: &[(String, Tensor)], metadata: (&str, &str)) -> Result<(), CheckpointError> {
    Ok(collect(metadata, tensors)?.save(path)?)
}

fn collect((key, value): (&str, &str), tensors: &[(String, Tensor)]) -> Result<TensorFile, CheckpointError> {
    tensors.iter().try_fold(TensorFile::new(key, value.to_owned()), |file, (name, tensor)| {
        let numbers = tensor.to_dtype(DType::F32)?.flatten_all()?.to_vec1()?;
        Ok(file.with(name, tensor.dims(), Numbers::F32(numbers)))
    })
}
