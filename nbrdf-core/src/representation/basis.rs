//! Learned bases as files: what codes were made with travels with them, and is not learned again.
//!
//! A file names its representation and its checkpoint, the mark that its codes carry; tensors are named by each basis.

use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::Representation;
use super::log_table::measurable;
use crate::tensor_file::{Number, Numbers, TensorFile, TensorFileError};

/// Metadata under which the header stands, as JSON.
const KEY: &str = "basis";
/// Largest file read \[bytes\]: 45 components over the grid of MERL are 0.8 GB.
const MAX_BYTES: u64 = 2 << 30;
/// Longest mark of a checkpoint.
const MAX_CHECKPOINT: usize = 64;

/// A representation that is learned, and is numbers.
pub trait Basis: Representation + Sized {
    /// Its numbers.
    fn to_file(&self) -> BasisFile;

    /// Of the numbers in a file, under the name that codes carry.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: other tensors than those of this basis, or numbers that are none of its.
    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError>;

    /// Writes it, whole or not at all.
    ///
    /// # Errors
    /// [`TensorFileError::Io`]: the file cannot be written.
    fn save(&self, path: &Path) -> Result<(), TensorFileError> {
        self.to_file().save(path)
    }
}

#[derive(Serialize, Deserialize)]
struct Header {
    schema: u32,
    name: String,
    checkpoint: String,
    details: serde_json::Value,
}

/// A basis on its way into a file, or out of one.
pub struct BasisFile {
    header: Header,
    tensors: TensorFile,
}

impl BasisFile {
    /// Of this representation, without numbers yet; `details` are what tensors cannot say.
    pub(super) fn new(basis: &dyn Representation, details: serde_json::Value) -> Self {
        let [name, checkpoint] = [basis.name(), basis.checkpoint()].map(str::to_owned);
        let header = Header { schema: 1, name, checkpoint, details };
        let tensors = TensorFile::new(KEY, serde_json::json!(header).to_string());
        Self { header, tensors }
    }

    /// With another tensor.
    pub(super) fn with(self, name: &str, shape: &[usize], numbers: Numbers) -> Self {
        Self { tensors: self.tensors.with(name, shape, numbers), ..self }
    }

    /// With rows of equal length as a tensor \[rows, columns\].
    pub(super) fn with_rows(self, name: &str, rows: &[Vec<f32>]) -> Self {
        let shape = [rows.len(), rows.first().map_or(0, Vec::len)];
        self.with(name, &shape, Numbers::F32(rows.concat()))
    }

    /// With indices as a tensor \[indices\].
    pub(super) fn with_indices(self, name: &str, indices: &[u32]) -> Self {
        self.with(name, &[indices.len()], Numbers::U32(indices.to_vec()))
    }

    /// Reads a file; none where it holds other tensors than those of a basis, as the checkpoint of an autoencoder does.
    ///
    /// # Errors
    /// [`TensorFileError`]: no such file, none of tensors, or a damaged one.
    pub fn open(path: &Path) -> Result<Option<Self>, TensorFileError> {
        const EXPECTED: &str = "a basis of schema 1";
        let (_, tensors) = TensorFile::load(path, MAX_BYTES)?;
        let Some(header) = tensors.metadata(KEY) else { return Ok(None) };
        let header: Header = serde_json::from_str(header).map_err(|error| tensors.lacks(EXPECTED, error))?;
        let Header { schema, ref checkpoint, .. } = header;
        if schema != 1 {
            return Err(tensors.lacks(EXPECTED, format!("schema {schema}")));
        }
        if checkpoint.is_empty()
            || checkpoint.len() > MAX_CHECKPOINT
            || !checkpoint.bytes().all(|byte| byte.is_ascii_graphic())
        {
            return Err(tensors.lacks("the mark of a checkpoint", format!("{checkpoint:?}")));
        }
        Ok(Some(Self { header, tensors }))
    }

    /// Writes it, whole or not at all.
    ///
    /// # Errors
    /// [`TensorFileError::Io`]: the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), TensorFileError> {
        self.tensors.save(path)
    }

    /// Name of the representation.
    pub fn name(&self) -> &str {
        &self.header.name
    }

    /// The mark that codes carry.
    pub fn checkpoint(&self) -> &str {
        &self.header.checkpoint
    }

    pub(super) fn details<T: DeserializeOwned>(&self) -> Result<T, TensorFileError> {
        let details = T::deserialize(&self.header.details);
        details.map_err(|error| self.lacks(format!("the details of {}", self.name()), error))
    }

    pub(super) fn shape(&self, name: &str) -> Result<&[usize], TensorFileError> {
        self.tensors.shape(name)
    }

    pub(super) fn tensor<T: Number>(&self, name: &str, shape: &[usize]) -> Result<&[T], TensorFileError> {
        self.tensors.tensor(name, shape)
    }

    pub(super) fn rows<T: Number>(&self, name: &str, columns: usize) -> Result<Vec<Vec<T>>, TensorFileError> {
        self.tensors.rows(name, columns)
    }

    /// Cells of a table, rising or not, all above the horizon, at least one.
    pub(super) fn cells(&self, name: &str) -> Result<Vec<usize>, TensorFileError> {
        let found = self.tensor::<u32>(name, self.shape(name)?)?;
        let cells: Vec<usize> = found.iter().map(|&cell| cell as usize).collect();
        let broken = cells.iter().find(|cell| measurable().binary_search(cell).is_err());
        match (broken, cells.is_empty()) {
            (None, false) => Ok(cells),
            (Some(cell), _) => Err(self.lacks(format!("cells above the horizon in '{name}'"), cell)),
            (None, true) => Err(self.lacks(format!("at least one cell in '{name}'"), "none")),
        }
    }

    pub(super) fn lacks(&self, expected: impl ToString, found: impl ToString) -> TensorFileError {
        self.tensors.lacks(expected, found)
    }
}
