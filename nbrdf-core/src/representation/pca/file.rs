//! Mean and components as tensors.

use super::Pca;
use crate::representation::basis::BasisFile;
use crate::tensor_file::{Numbers, TensorFileError};

impl Pca {
    /// With `mean` \[numbers\] and `components` \[components, numbers\].
    pub(in crate::representation) fn write_into(&self, file: BasisFile) -> BasisFile {
        let mean = Numbers::F32(self.mean.clone());
        file.with("mean", &[self.mean.len()], mean).with_rows("components", &self.components)
    }

    /// Of rows with so many numbers.
    pub(in crate::representation) fn of_file(file: &BasisFile, numbers: usize) -> Result<Self, TensorFileError> {
        let mean = file.tensor("mean", &[numbers])?.to_vec();
        Ok(Self { mean, components: file.rows("components", numbers)? })
    }
}
