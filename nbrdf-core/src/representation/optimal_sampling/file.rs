//! Components and directions as a file.

use std::sync::Arc;

use super::log_relative::LogRelative;
use super::{DAMPING, OptimalSampling, Reconstruction};
use crate::representation::basis::{Basis, BasisFile};
use crate::tensor_file::TensorFileError;

impl Basis for OptimalSampling {
    fn to_file(&self) -> BasisFile {
        let basis = &self.reconstruction.basis;
        let cells: Vec<u32> = self.cells().iter().map(|&cell| cell as u32).collect();
        basis.write_into(BasisFile::new(self, serde_json::json!({"rows": basis.rows()})).with_indices("cells", &cells))
    }

    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError> {
        let basis = Arc::new(LogRelative::of_file(file)?);
        let reconstruction = Reconstruction::new(basis, file.cells("cells")?, DAMPING);
        Ok(Self { name, reconstruction, checkpoint: file.checkpoint().to_owned() })
    }
}
