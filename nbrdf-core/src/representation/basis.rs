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
/// Longest name and mark.
const LONGEST_NAME: usize = 64;

/// A representation that is learned, and is numbers.
pub trait Basis: Representation + Sized {
    /// Its numbers.
    fn to_file(&self) -> BasisFile;

    /// Of the numbers in a file, under the name that codes carry.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: other tensors than those of this basis, or numbers that are none of its.
    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError>;
}

#[derive(Serialize, Deserialize)]
struct Header {
    schema: u32,
    name: String,
    checkpoint: String,
    /// Whether the validation materials were left out, too.
    #[serde(default)]
    validate: bool,
    details: serde_json::Value,
}

/// What a file of tensors turned out to hold.
pub enum Opened {
    /// A basis.
    Basis(BasisFile),
    /// The bytes of something else.
    Other(Vec<u8>),
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
        let header = Header { schema: 1, name, checkpoint, validate: false, details };
        Self { header, tensors: TensorFile::new(KEY, String::new()) }
    }

    /// Of a basis that has not seen the validation materials either, or has.
    #[must_use]
    pub fn without_validation(mut self, validate: bool) -> Self {
        self.header.validate = validate;
        self
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

    /// Reads a file: a basis, or the bytes of something else, as the checkpoint of an autoencoder is.
    ///
    /// # Errors
    /// [`TensorFileError`]: no such file, none of tensors, or a damaged one.
    pub fn open(path: &Path) -> Result<Opened, TensorFileError> {
        let bytes = TensorFile::read(path, MAX_BYTES)?;
        let basis = Self::parse(&path.display().to_string(), &bytes)?;
        Ok(basis.map_or(Opened::Other(bytes), Opened::Basis))
    }

    /// The basis in bytes that came from `path`; none where they are something else.
    ///
    /// # Errors
    /// [`TensorFileError::Invalid`]: no tensors, or damaged ones.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Option<Self>, TensorFileError> {
        let header = TensorFile::metadata_in(path, bytes, KEY)?;
        header.map(|header| Self::of(&header, TensorFile::parse(path, bytes)?)).transpose()
    }

    fn of(header: &str, tensors: TensorFile) -> Result<Self, TensorFileError> {
        const EXPECTED: &str = "a basis of schema 1";
        let header: Header = serde_json::from_str(header).map_err(|error| tensors.lacks(EXPECTED, error))?;
        if header.schema != 1 {
            return Err(tensors.lacks(EXPECTED, format!("schema {}", header.schema)));
        }
        let is_word =
            |text: &str| (1..=LONGEST_NAME).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_graphic());
        if let Some(text) = [&header.name, &header.checkpoint].into_iter().find(|text| !is_word(text)) {
            return Err(tensors.lacks("the name and the mark of a basis", format!("{text:?}")));
        }
        Ok(Self { header, tensors })
    }

    /// Writes it, whole or not at all.
    ///
    /// # Errors
    /// [`TensorFileError`]: larger than what is read again, or the file cannot be written.
    pub fn save(self, path: &Path) -> Result<(), TensorFileError> {
        let Self { header, tensors } = self;
        let tensors = tensors.with_metadata(KEY, serde_json::json!(header).to_string());
        let bytes = 4 * tensors.shapes().map(|(_, shape)| shape.iter().product::<usize>() as u64).sum::<u64>();
        if bytes > MAX_BYTES {
            return Err(tensors.lacks(format!("a basis of at most {MAX_BYTES} bytes"), format!("{bytes}")));
        }
        tensors.save(path)
    }

    /// Name of the representation.
    pub fn name(&self) -> &str {
        &self.header.name
    }

    /// The mark that codes carry.
    pub fn checkpoint(&self) -> &str {
        &self.header.checkpoint
    }

    /// Whether it has not seen the validation materials.
    pub const fn is_without_validation(&self) -> bool {
        self.header.validate
    }

    pub(super) fn details<T: DeserializeOwned>(&self) -> Result<T, TensorFileError> {
        let details = T::deserialize(&self.header.details);
        details.map_err(|error| self.lacks(format!("the details of {}", self.name()), error))
    }

    pub(super) fn shape(&self, name: &str) -> Result<&[usize], TensorFileError> {
        self.tensors.shape(name)
    }

    /// The numbers of a tensor of this shape, none beyond ±`largest`.
    pub(super) fn tensor<T: Number>(&self, name: &str, shape: &[usize], largest: f64) -> Result<&[T], TensorFileError> {
        self.tensors.check_within(name, largest)?;
        self.tensors.tensor(name, shape)
    }

    /// The rows of a tensor of so many columns, no number beyond ±`largest`.
    pub(super) fn rows<T: Number>(
        &self,
        name: &str,
        columns: usize,
        largest: f64,
    ) -> Result<Vec<Vec<T>>, TensorFileError> {
        self.tensors.check_within(name, largest)?;
        self.tensors.rows(name, columns)
    }

    /// Cells of a table, rising, all above the horizon, at least one.
    pub(super) fn cells(&self, name: &str) -> Result<Vec<usize>, TensorFileError> {
        let found: &[u32] = self.tensors.tensor(name, self.shape(name)?)?;
        let cells: Vec<usize> = found.iter().map(|&cell| cell as usize).collect();
        if cells.is_empty() || !cells.is_sorted_by(|a, b| a < b) {
            return Err(self.lacks(format!("one or more rising cells in '{name}'"), "others"));
        }
        match cells.iter().find(|cell| measurable().binary_search(cell).is_err()) {
            Some(cell) => Err(self.lacks(format!("cells above the horizon in '{name}'"), cell)),
            None => Ok(cells),
        }
    }

    pub(super) fn lacks(&self, expected: impl ToString, found: impl ToString) -> TensorFileError {
        self.tensors.lacks(expected, found)
    }
}
