//! The measured materials of a combination as a file.

use std::sync::Arc;

use super::LinearCombination;
use crate::representation::basis::{Basis, BasisFile};
use crate::representation::measured_tables::MeasuredTables;
use crate::tensor_file::TensorFileError;

impl Basis for LinearCombination {
    fn to_file(&self) -> BasisFile {
        let cells: Vec<u32> = self.coefficients.cells().iter().map(|&cell| cell as u32).collect();
        let file = BasisFile::new(self, serde_json::Value::Null).with_indices("cells", &cells);
        self.coefficients.basis().write_into(file)
    }

    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError> {
        let cells = file.cells("cells")?;
        let basis = Arc::new(MeasuredTables::of_file(file)?);
        Self::new(name, basis, cells).map_err(|error| file.lacks("materials that differ", error))
    }
}
