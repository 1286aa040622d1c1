//! Mean and components as tensors.

use super::Pca;
use crate::representation::basis::BasisFile;
use crate::tensor_file::{Numbers, TensorFileError};

/// Tables hold reflectances, their logarithms, or weights of networks.
const LARGEST: f64 = 1e15;
/// Components are unit vectors, up to rounding.
const LARGEST_OF_UNIT: f64 = 1.001;

impl Pca {
    /// With `mean` \[numbers\] and `components` \[components, numbers\].
    pub(in crate::representation) fn write_into(&self, file: BasisFile) -> BasisFile {
        let mean = Numbers::F32(self.mean.clone());
        file.with("mean", &[self.mean.len()], mean).with_rows("components", &self.components)
    }

    /// Of rows with so many numbers.
    pub(in crate::representation) fn of_file(file: &BasisFile, numbers: usize) -> Result<Self, TensorFileError> {
        let mean = file.tensor("mean", &[numbers], LARGEST)?.to_vec();
        Ok(Self { mean, components: file.rows("components", numbers, LARGEST_OF_UNIT)? })
    }
}
