//! Learned things as files: safetensors of finite numbers with one pair of metadata, written whole or not at all.

mod numbers;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use safetensors::{SafeTensorError, SafeTensors, serialize};

use crate::{atomic, bounded};
use numbers::{Stored, numbers};

pub use numbers::{Number, Numbers};

/// Why a file of tensors could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum TensorFileError {
    /// Reading or writing failed.
    #[error("{path}")]
    Io {
        /// The file.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is something else, or damaged.
    #[error("{path}: expected {expected}, found {found}; make it again with `nbrdf train` or `nbrdf learn`")]
    Invalid {
        /// The file.
        path: String,
        /// What should have been there.
        expected: String,
        /// What was there.
        found: String,
    },
}

impl TensorFileError {
    /// Of more than `max` bytes.
    pub fn too_long(path: &str, max: u64) -> Self {
        invalid(path, format!("at most {max} bytes"), "more")
    }
}

/// Tensors by name.
#[derive(Clone, Debug, PartialEq)]
pub struct TensorFile {
    path: String,
    tensors: BTreeMap<String, (Vec<usize>, Numbers)>,
    metadata: HashMap<String, String>,
}

impl TensorFile {
    /// Without tensors yet. One pair of metadata only: with more, the order of a hash map would decide over the bytes.
    pub fn new(key: &str, value: String) -> Self {
        let metadata = HashMap::from([(key.to_owned(), value)]);
        Self { path: "memory".to_owned(), tensors: BTreeMap::new(), metadata }
    }

    /// With another tensor.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, shape: &[usize], numbers: Numbers) -> Self {
        self.tensors.insert(name.into(), (shape.to_vec(), numbers));
        self
    }

    /// The bytes of a file, `max` at most.
    ///
    /// # Errors
    /// [`TensorFileError`]: no such file, or a longer one.
    pub fn read(path: &Path, max: u64) -> Result<Vec<u8>, TensorFileError> {
        let name = path.display().to_string();
        let bytes = bounded::read(path, max).map_err(|source| TensorFileError::Io { path: name.clone(), source })?;
        bytes.ok_or_else(|| TensorFileError::too_long(&name, max))
    }

    /// The metadata in the bytes of a file, before its numbers are looked at.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: no safetensors.
    pub fn metadata_in(path: &str, bytes: &[u8], key: &str) -> Result<Option<String>, TensorFileError> {
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(|error| damaged(path, &error))?;
        Ok(header.metadata().as_ref().and_then(|metadata| metadata.get(key).cloned()))
    }

    /// The tensors in bytes that came from `path`.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: no safetensors, numbers that are not finite, or of another kind than [`Numbers`].
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self, TensorFileError> {
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(|error| damaged(path, &error))?;
        let metadata = header.metadata().clone().unwrap_or_default();
        let mut tensors = BTreeMap::new();
        for (name, view) in SafeTensors::deserialize(bytes).map_err(|error| damaged(path, &error))?.tensors() {
            let numbers = numbers(&view).ok_or_else(|| {
                invalid(path, format!("F32, F64 or U32 in tensor '{name}'"), format!("{:?}", view.dtype()))
            })?;
            if let Some(value) = numbers.beyond(f64::MAX) {
                return Err(invalid(path, format!("finite numbers in tensor '{name}'"), value));
            }
            tensors.insert(name, (view.shape().to_vec(), numbers));
        }
        Ok(Self { path: path.to_owned(), tensors, metadata })
    }

    /// Where it came from.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The metadata under this key.
    pub fn metadata(&self, key: &str) -> Option<&str> {
        self.metadata.get(key).map(String::as_str)
    }

    /// All names and shapes.
    pub fn shapes(&self) -> impl Iterator<Item = (&str, &[usize])> {
        self.tensors.iter().map(|(name, (shape, _))| (name.as_str(), shape.as_slice()))
    }

    /// The same tensors with other metadata.
    #[must_use]
    pub fn with_metadata(self, key: &str, value: String) -> Self {
        Self { metadata: HashMap::from([(key.to_owned(), value)]), ..self }
    }

    /// The shape of a tensor.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: none of that name.
    pub fn shape(&self, name: &str) -> Result<&[usize], TensorFileError> {
        let found = self.tensors.get(name).map(|(shape, _)| shape.as_slice());
        found.ok_or_else(|| self.lacks(format!("tensor '{name}'"), "none of that name"))
    }

    /// The numbers of a tensor of this shape.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: none of that name, of another shape, or of another kind of numbers.
    pub fn tensor<T: Number>(&self, name: &str, shape: &[usize]) -> Result<&[T], TensorFileError> {
        let found = self.shape(name)?;
        if found != shape {
            return Err(self.lacks(format!("tensor '{name}' of shape {shape:?}"), format!("shape {found:?}")));
        }
        let numbers = self.tensors.get(name).and_then(|(_, numbers)| T::of(numbers));
        numbers.ok_or_else(|| self.lacks(format!("tensor '{name}' of {}", T::KIND), "another kind of numbers"))
    }

    /// The rows of a tensor \[rows, columns\] of so many columns, at least one.
    ///
    /// # Errors
    /// As [`tensor`](Self::tensor).
    pub fn rows<T: Number>(&self, name: &str, columns: usize) -> Result<Vec<Vec<T>>, TensorFileError> {
        match self.shape(name)? {
            &[count, found] if found == columns && count > 0 && columns > 0 => {
                let numbers = self.tensor::<T>(name, &[count, columns])?;
                Ok(numbers.chunks_exact(columns).map(<[T]>::to_vec).collect())
            }
            found => Err(self.lacks(format!("tensor '{name}' of shape [rows, {columns}]"), format!("shape {found:?}"))),
        }
    }

    /// The error of a file that is not what it should be.
    pub fn lacks(&self, expected: impl ToString, found: impl ToString) -> TensorFileError {
        invalid(&self.path, expected, found)
    }

    /// Refuses a tensor with a number beyond ±`largest`.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`] naming tensor and number.
    pub fn check_within(&self, name: &str, largest: f64) -> Result<(), TensorFileError> {
        let beyond = self.tensors.get(name).and_then(|(_, numbers)| numbers.beyond(largest));
        match beyond {
            Some(value) => Err(self.lacks(format!("numbers within ±{largest:e} in tensor '{name}'"), value)),
            None => Ok(()),
        }
    }

    /// Writes it, whole or not at all; the same tensors give the same bytes.
    ///
    /// # Errors
    /// [`TensorFileError::Io`]: the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), TensorFileError> {
        let name = path.display().to_string();
        let tensors = self.tensors.iter().map(|(name, (shape, numbers))| (name, Stored { shape, numbers }));
        let bytes = serialize(tensors, Some(self.metadata.clone()))
            .map_err(|error| invalid(&name, "tensors to write", error))?;
        atomic::write(path, &bytes).map_err(|source| TensorFileError::Io { path: name, source })
    }
}

fn damaged(path: &str, error: &SafeTensorError) -> TensorFileError {
    invalid(path, "a safetensors file", error)
}

fn invalid(path: &str, expected: impl ToString, found: impl ToString) -> TensorFileError {
    TensorFileError::Invalid { path: path.to_owned(), expected: expected.to_string(), found: found.to_string() }
}

#[cfg(test)]
mod tests;
