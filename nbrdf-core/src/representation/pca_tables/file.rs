//! A basis over tables as a file.

use serde::Deserialize;

use super::{PcaOptions, PcaTables};
use crate::representation::basis::{Basis, BasisFile};
use crate::representation::grid::Grid;
use crate::representation::pca::Pca;
use crate::representation::values::Values;
use crate::tensor_file::TensorFileError;

#[derive(Deserialize)]
struct Details {
    values: Values,
    grid: Grid,
}

impl Basis for PcaTables {
    fn to_file(&self) -> BasisFile {
        let PcaOptions { values, grid, .. } = self.options;
        self.pca.write_into(BasisFile::new(self, serde_json::json!({"values": values, "grid": grid})))
    }

    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError> {
        let Details { values, grid } = file.details()?;
        let pca = Pca::of_file(file, grid.numbers())?;
        let options = PcaOptions { name, components: pca.components.len(), values, grid };
        Ok(Self { options, pca, checkpoint: file.checkpoint().to_owned() })
    }
}
