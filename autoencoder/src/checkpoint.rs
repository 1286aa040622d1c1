//! Trained autoencoders as files: safetensors, with the model's name in the metadata; written whole or not at all.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use candle_core::{DType, Device, Tensor};
use nbrdf_core::{atomic, hash};
use safetensors::tensor::{Dtype, TensorView};
use safetensors::{SafeTensors, serialize};

use crate::model::Model;
use crate::parameters::Parameter;
use crate::probe::{PROBES, probe_directions};

/// Largest checkpoint read \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// Why a file is no checkpoint, or could not be written.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// Reading or writing failed.
    #[error("{path}")]
    Io {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is something else, or damaged.
    #[error("{path}: expected {expected}, found {found}; train it again with `nbrdf train`")]
    Invalid {
        /// The file.
        path: String,
        /// What should have been there.
        expected: String,
        /// What was there.
        found: String,
    },
    /// The tensor library failed (a bug, or out of memory).
    #[error("tensor library: {0}")]
    Tensor(#[from] candle_core::Error),
}

/// A file's tensors and metadata, checked to be finite f32.
pub(crate) struct Checkpoint {
    pub path: String,
    pub tensors: BTreeMap<String, (Vec<usize>, Vec<f32>)>,
    pub metadata: HashMap<String, String>,
    /// First 16 hexadecimal digits of the file's SHA-256.
    pub hash: String,
}

impl Checkpoint {
    /// Reads a file.
    pub fn load(path: &Path) -> Result<Self, CheckpointError> {
        let name = path.display().to_string();
        let io = |source| CheckpointError::Io { path: name.clone(), source };
        let size = std::fs::metadata(path).map_err(io)?.len();
        if size > MAX_BYTES {
            return Err(invalid(&name, format!("at most {MAX_BYTES} bytes"), format!("{size} bytes")));
        }
        Self::parse(&name, &std::fs::read(path).map_err(io)?)
    }

    /// Reads bytes that came from `path`.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self, CheckpointError> {
        let damaged =
            |error: safetensors::SafeTensorError| invalid(path, "a safetensors file".into(), error.to_string());
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(damaged)?;
        let metadata = header.metadata().clone().unwrap_or_default();
        let mut tensors = BTreeMap::new();
        for (name, view) in SafeTensors::deserialize(bytes).map_err(damaged)?.tensors() {
            if view.dtype() != Dtype::F32 {
                return Err(invalid(path, format!("F32 in tensor '{name}'"), format!("{:?}", view.dtype())));
            }
            let bytes = view.data().as_chunks().0;
            let values: Vec<f32> = bytes.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
            if let Some(value) = values.iter().find(|v| !v.is_finite()) {
                return Err(invalid(path, format!("finite numbers in tensor '{name}'"), value.to_string()));
            }
            tensors.insert(name, (view.shape().to_vec(), values));
        }
        Ok(Self { path: path.into(), tensors, metadata, hash: hash::sha256(bytes)[..16].to_owned() })
    }

    /// The tensors of a model under training.
    pub fn of(model: &dyn Model) -> Result<Self, CheckpointError> {
        let numbers = |(name, tensor): (String, Tensor)| -> Result<_, CheckpointError> {
            Ok((name, (tensor.dims().to_vec(), tensor.flatten_all()?.to_vec1()?)))
        };
        let tensors = tensors_of(model).into_iter().map(numbers).collect::<Result<_, _>>()?;
        Ok(Self { path: "training".into(), tensors, metadata: HashMap::new(), hash: "untrained".into() })
    }

    /// Trainable numbers: those of the layers.
    pub fn parameters(&self) -> usize {
        let is_layer = |name: &str| name.ends_with(".weight") || name.ends_with(".bias");
        self.tensors.iter().filter(|(name, _)| is_layer(name)).map(|(_, (_, values))| values.len()).sum()
    }

    /// The numbers of a tensor of this shape.
    pub fn tensor(&self, name: &str, shape: &[usize]) -> Result<&[f32], CheckpointError> {
        match self.tensors.get(name) {
            None => Err(invalid(&self.path, format!("tensor '{name}'"), "none of that name".into())),
            Some((found, _)) if found != shape => {
                Err(invalid(&self.path, format!("tensor '{name}' of shape {shape:?}"), format!("shape {found:?}")))
            }
            Some((_, values)) => Ok(values),
        }
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
                return Err(invalid(&self.path, format!("this version's {name}"), "others".into()));
            }
        }
        Ok(())
    }
}

pub(crate) fn invalid(path: &str, expected: String, found: String) -> CheckpointError {
    CheckpointError::Invalid { path: path.into(), expected, found }
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
pub(crate) fn save(
    path: &Path,
    tensors: &[(String, Tensor)],
    (key, value): (&str, &str),
) -> Result<(), CheckpointError> {
    let mut data = BTreeMap::new();
    for (name, tensor) in tensors {
        let numbers = tensor.to_dtype(DType::F32)?.flatten_all()?.to_vec1::<f32>()?;
        let bytes: Vec<u8> = numbers.iter().flat_map(|v| v.to_le_bytes()).collect();
        data.insert(name.clone(), (tensor.dims().to_vec(), bytes));
    }
    let name = path.display().to_string();
    let failed = |error: safetensors::SafeTensorError| invalid(&name, "tensors to write".into(), error.to_string());
    let views =
        data.iter().map(|(name, (shape, bytes))| Ok((name, TensorView::new(Dtype::F32, shape.clone(), bytes)?)));
    let views = views.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    // One pair only: with more, the order of a hash map would decide over the bytes.
    let metadata = HashMap::from([(key.to_owned(), value.to_owned())]);
    let bytes = serialize(views, Some(metadata)).map_err(failed)?;
    atomic::write(path, &bytes).map_err(|source| CheckpointError::Io { path: name, source })
}
