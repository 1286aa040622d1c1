//! Linear PCA over log tables: the row to beat.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 5, with the log mapping that J. Nielsen et al.,
//! *On Optimal, Minimal BRDF Sampling* (2015), section 4.1 argue for. Differs: ln(f c + 10⁻³) instead of log-relative.

use super::log_table::LogTable;
use super::pca::{Pca, PcaError};
use super::pca_weights::checkpoint_of;
use super::{Code, DecodeError, EncodeError, Representation};
use crate::{Brdf, Material};

/// Components over [`LogTable`]s.
pub struct PcaTables {
    pca: Pca,
    checkpoint: String,
}

impl PcaTables {
    /// Learns `count` components; 32 for the published comparison.
    pub fn learn(training: &[Material], count: usize) -> Result<Self, PcaError> {
        let rows = training.iter().map(|material| LogTable::tabulate(material.brdf.as_ref())).collect();
        let pca = Pca::learn(rows, count)?;
        let checkpoint = checkpoint_of(training, count);
        Ok(Self { pca, checkpoint })
    }
}

impl Representation for PcaTables {
    fn name(&self) -> &'static str {
        "pca_tables"
    }

    fn dim(&self) -> usize {
        self.pca.components.len()
    }

    fn checkpoint(&self) -> &str {
        &self.checkpoint
    }

    fn shared_bytes(&self) -> usize {
        self.pca.bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let table = LogTable::tabulate(target.brdf.as_ref());
        if table.iter().any(|v| !v.is_finite()) {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        }
        Ok(self.code(self.pca.project(&table)))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        let code = code.checked(self.name(), &self.checkpoint, self.dim())?;
        Ok(Box::new(LogTable::new(self.pca.reconstruct(code))))
    }
}
