//! The affine span of the training materials' log tables, in which a table is as many numbers as there are materials.

use super::Options;
use crate::Material;
use crate::hash::short_hash;
use crate::representation::EncodeError;
use crate::representation::log_table;
use crate::representation::measured_tables::hash_of;
use crate::representation::pca::{Pca, PcaError};

/// All principal components of the training tables: distances between tables are those between their coordinates.
pub struct Span {
    pub(super) pca: Pca,
    pub(super) training: Vec<Vec<f64>>,
    pub(super) names: Vec<String>,
    pub(super) checkpoint: String,
}

impl Span {
    /// Of these materials.
    pub fn learn(training: &[Material]) -> Result<Self, PcaError> {
        let tables: Vec<Vec<f32>> =
            training.iter().map(|material| log_table::tabulate(material.brdf.as_ref())).collect();
        let pca = Pca::learn(tables.clone(), training.len().saturating_sub(1))?;
        let training_at = tables.iter().map(|table| coordinates(&pca, table)).collect();
        let names = training.iter().map(|material| material.name.clone()).collect();
        let checkpoint = hash_of(training, &tables);
        Ok(Self { pca, training: training_at, names, checkpoint })
    }

    /// Coordinates of the training materials, largest variance first.
    pub fn training(&self) -> &[Vec<f64>] {
        &self.training
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Coordinates of the point of the span nearest to a material's table; the first few are its PCA code of that size.
    pub fn project(&self, target: &Material) -> Result<Vec<f64>, EncodeError> {
        let table = log_table::tabulate(target.brdf.as_ref());
        if table.iter().any(|v| !v.is_finite()) {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        }
        Ok(coordinates(&self.pca, &table))
    }

    /// The table at these coordinates, the missing ones 0.
    pub fn reconstruct(&self, at: &[f64]) -> Vec<f32> {
        self.pca.reconstruct(&at.iter().map(|&v| v as f32).collect::<Vec<f32>>())
    }

    /// Bytes of mean and components.
    pub fn bytes(&self) -> usize {
        self.pca.bytes()
    }

    /// Hash of the training materials.
    pub(super) fn learned_from(&self) -> &str {
        &self.checkpoint
    }

    /// Hash of what a chart is learned from.
    pub(super) fn checkpoint(&self, options: Options) -> String {
        let Options { dim, charts, neighbours, shared, ridge } = options;
        let how = [dim as f32, charts.min(self.training.len()) as f32, neighbours as f32, shared as f32, ridge as f32];
        format!("{}-{}", self.checkpoint, &short_hash(how.into_iter())[..4])
    }
}

fn coordinates(pca: &Pca, table: &[f32]) -> Vec<f64> {
    pca.project(table).into_iter().map(f64::from).collect()
}
