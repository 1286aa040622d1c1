//! What is learned, as a file: safetensors of finite numbers with one pair of metadata, written whole or not at all.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use safetensors::tensor::{Dtype, TensorView, View};
use safetensors::{SafeTensorError, SafeTensors, serialize};

use crate::atomic;

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

/// Numbers of one kind, all finite.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Single precision.
    F32(Vec<f32>),
    /// Double precision.
    F64(Vec<f64>),
    /// Indices.
    U32(Vec<u32>),
}

/// A kind of numbers.
pub trait Number: Copy {
    /// Its name in the file.
    const KIND: Dtype;

    /// These numbers, if they are of this kind.
    fn of(numbers: &Numbers) -> Option<&[Self]>;
}

impl Number for f32 {
    const KIND: Dtype = Dtype::F32;

    fn of(numbers: &Numbers) -> Option<&[Self]> {
        if let Numbers::F32(own) = numbers { Some(own) } else { None }
    }
}

impl Number for f64 {
    const KIND: Dtype = Dtype::F64;

    fn of(numbers: &Numbers) -> Option<&[Self]> {
        if let Numbers::F64(own) = numbers { Some(own) } else { None }
    }
}

impl Number for u32 {
    const KIND: Dtype = Dtype::U32;

    fn of(numbers: &Numbers) -> Option<&[Self]> {
        if let Numbers::U32(own) = numbers { Some(own) } else { None }
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

    /// Reads a file of at most `max` bytes: the bytes, for hashing them, and the tensors.
    pub fn load(path: &Path, max: u64) -> Result<(Vec<u8>, Self), TensorFileError> {
        let name = path.display().to_string();
        let io = |source| TensorFileError::Io { path: name.clone(), source };
        let size = std::fs::metadata(path).map_err(io)?.len();
        if size > max {
            return Err(invalid(&name, format!("at most {max} bytes"), format!("{size} bytes")));
        }
        let bytes = std::fs::read(path).map_err(io)?;
        let file = Self::parse(&name, &bytes)?;
        Ok((bytes, file))
    }

    /// Reads bytes that came from `path`.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self, TensorFileError> {
        let damaged = |error: SafeTensorError| invalid(path, "a safetensors file", error);
        let (_, header) = SafeTensors::read_metadata(bytes).map_err(damaged)?;
        let metadata = header.metadata().clone().unwrap_or_default();
        let mut tensors = BTreeMap::new();
        for (name, view) in SafeTensors::deserialize(bytes).map_err(damaged)?.tensors() {
            let numbers = numbers(&view).ok_or_else(|| {
                invalid(path, format!("F32, F64 or U32 in tensor '{name}'"), format!("{:?}", view.dtype()))
            })?;
            if let Some(value) = not_finite(&numbers) {
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

    /// The shape of a tensor.
    pub fn shape(&self, name: &str) -> Result<&[usize], TensorFileError> {
        let found = self.tensors.get(name).map(|(shape, _)| shape.as_slice());
        found.ok_or_else(|| self.lacks(format!("tensor '{name}'"), "none of that name"))
    }

    /// The numbers of a tensor of this shape.
    pub fn tensor<T: Number>(&self, name: &str, shape: &[usize]) -> Result<&[T], TensorFileError> {
        let found = self.shape(name)?;
        if found != shape {
            return Err(self.lacks(format!("tensor '{name}' of shape {shape:?}"), format!("shape {found:?}")));
        }
        let numbers = self.tensors.get(name).and_then(|(_, numbers)| T::of(numbers));
        numbers.ok_or_else(|| self.lacks(format!("tensor '{name}' of {:?}", T::KIND), "another kind of numbers"))
    }

    /// The rows of a tensor \[rows, columns\] of so many columns, at least one.
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

    /// Writes it; the same tensors give the same bytes.
    pub fn save(&self, path: &Path) -> Result<(), TensorFileError> {
        let name = path.display().to_string();
        let failed = |error: SafeTensorError| invalid(&name, "tensors to write", error);
        let tensors = self.tensors.iter().map(|(name, (shape, numbers))| (name, Stored { shape, numbers }));
        let bytes = serialize(tensors, Some(self.metadata.clone())).map_err(failed)?;
        atomic::write(path, &bytes).map_err(|source| TensorFileError::Io { path: name, source })
    }
}

fn invalid(path: &str, expected: impl ToString, found: impl ToString) -> TensorFileError {
    TensorFileError::Invalid { path: path.to_owned(), expected: expected.to_string(), found: found.to_string() }
}

fn numbers(view: &TensorView) -> Option<Numbers> {
    let words = || view.data().as_chunks().0.iter();
    match view.dtype() {
        Dtype::F32 => Some(Numbers::F32(words().map(|word| f32::from_le_bytes(*word)).collect())),
        Dtype::U32 => Some(Numbers::U32(words().map(|word| u32::from_le_bytes(*word)).collect())),
        Dtype::F64 => Some(Numbers::F64(view.data().as_chunks().0.iter().map(|w| f64::from_le_bytes(*w)).collect())),
        _ => None,
    }
}

fn not_finite(numbers: &Numbers) -> Option<f64> {
    match numbers {
        Numbers::F32(own) => own.iter().find(|v| !v.is_finite()).map(|&v| v.into()),
        Numbers::F64(own) => own.iter().copied().find(|v| !v.is_finite()),
        Numbers::U32(_) => None,
    }
}

/// A tensor on its way into a file; bases are large, and where memory holds the file's bytes they are not copied.
struct Stored<'a> {
    shape: &'a [usize],
    numbers: &'a Numbers,
}

impl View for Stored<'_> {
    fn dtype(&self) -> Dtype {
        match self.numbers {
            Numbers::F32(_) => f32::KIND,
            Numbers::F64(_) => f64::KIND,
            Numbers::U32(_) => u32::KIND,
        }
    }

    fn shape(&self) -> &[usize] {
        self.shape
    }

    fn data(&self) -> Cow<'_, [u8]> {
        match self.numbers {
            Numbers::F32(own) if cfg!(target_endian = "little") => Cow::Borrowed(bytemuck::cast_slice(own)),
            Numbers::F32(own) => own.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Numbers::F64(own) => own.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Numbers::U32(own) => own.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }

    fn data_len(&self) -> usize {
        match self.numbers {
            Numbers::F32(own) => size_of_val(own.as_slice()),
            Numbers::F64(own) => size_of_val(own.as_slice()),
            Numbers::U32(own) => size_of_val(own.as_slice()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> TensorFile {
        TensorFile::new("model", "sample".to_owned())
            .with("single", &[2, 3], Numbers::F32(vec![1.5, -2.0, 0.0, 3.0, 1e-30, 1e30]))
            .with("double", &[2], Numbers::F64(vec![0.1, f64::MAX]))
            .with("index", &[1], Numbers::U32(vec![u32::MAX]))
    }

    #[test]
    fn what_is_written_is_read_and_the_same_tensors_give_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let paths = ["a", "b"].map(|name| folder.path().join(name));
        let [first, second] = paths.each_ref().map(|path| {
            sample().save(path).unwrap();
            TensorFile::load(path, 4096).unwrap()
        });
        assert_eq!(first.0, second.0);
        assert_eq!(first.1.metadata("model"), Some("sample"));
        assert_eq!(first.1.rows::<f32>("single", 3).unwrap(), [[1.5, -2.0, 0.0], [3.0, 1e-30, 1e30]]);
        assert_eq!(first.1.tensor::<f64>("double", &[2]).unwrap(), [0.1, f64::MAX]);
        assert_eq!(first.1.tensor::<u32>("index", &[1]).unwrap(), [u32::MAX]);
    }

    #[test]
    fn errors_say_what_was_expected_and_what_was_found() {
        let of = |error: TensorFileError| error.to_string();
        assert!(of(sample().shape("other").unwrap_err()).contains("expected tensor 'other', found none"));
        assert!(of(sample().tensor::<f32>("single", &[6]).unwrap_err()).contains("[6], found shape [2, 3]"));
        assert!(of(sample().tensor::<f32>("double", &[2]).unwrap_err()).contains("of F32"));
        assert!(of(sample().rows::<f32>("single", 2).unwrap_err()).contains("[rows, 2], found shape [2, 3]"));
    }

    #[test]
    fn numbers_that_are_not_finite_other_kinds_and_large_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let saved = |numbers: Numbers| {
            TensorFile::new("k", String::new()).with("t", &[1], numbers).save(&path).unwrap();
            TensorFile::load(&path, 4096).map(|_| ())
        };
        assert!(saved(Numbers::F32(vec![f32::NAN])).unwrap_err().to_string().contains("finite numbers in tensor 't'"));
        assert!(saved(Numbers::F64(vec![f64::INFINITY])).unwrap_err().to_string().contains("finite"));
        assert!(TensorFile::load(&path, 10).unwrap_err().to_string().contains("at most 10 bytes"));
        let half = TensorView::new(Dtype::F16, vec![1], &[0, 0]).unwrap();
        let half = serialize([("t", half)], None).unwrap();
        assert!(TensorFile::parse("x", &half).unwrap_err().to_string().contains("found F16"));
        assert!(TensorFile::parse("x", b"{}").unwrap_err().to_string().contains("a safetensors file"));
    }
}
