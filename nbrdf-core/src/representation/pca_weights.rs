//! Linear PCA over the flattened weights of networks: what happens if weights are taken for plain vectors.

use super::basis::{Basis, BasisFile};
use super::pca::{Pca, PcaError};
use super::{Code, DecodeError, EncodeError, Representation};
use crate::hash::short_hash;
use crate::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};
use crate::tensor_file::TensorFileError;
use crate::{Brdf, Material, Nbrdf};

/// Components over the 675 weights.
pub struct PcaWeights {
    pca: Pca,
    checkpoint: String,
}

impl PcaWeights {
    /// Learns `count` components from the materials that have a network of the published shape.
    pub fn learn(training: &[Material], count: usize) -> Result<Self, PcaError> {
        let networks = training.iter().filter_map(|material| material.network.as_ref());
        let published = networks.filter(|network| network.hidden() == PUBLISHED_HIDDEN);
        let rows = published.map(|network| network.weights().to_vec()).collect();
        let pca = Pca::learn(rows, count)?;
        let checkpoint = checkpoint_of(training, &[count]);
        Ok(Self { pca, checkpoint })
    }

    fn reconstruct(&self, code: &Code) -> Result<Nbrdf, DecodeError> {
        let code = code.checked(self.name(), &self.checkpoint, self.dim())?;
        Nbrdf::published(self.pca.reconstruct(code)).map_err(|error| DecodeError::Failed(error.to_string()))
    }
}

impl Basis for PcaWeights {
    fn to_file(&self) -> BasisFile {
        self.pca.write_into(BasisFile::new(self, serde_json::Value::Null))
    }

    fn of_file(_: &'static str, file: &BasisFile) -> Result<Self, TensorFileError> {
        let pca = Pca::of_file(file, PUBLISHED_WEIGHTS)?;
        Ok(Self { pca, checkpoint: file.checkpoint().to_owned() })
    }
}

impl Representation for PcaWeights {
    fn name(&self) -> &'static str {
        "pca_weights"
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
        Ok(self.code(self.pca.project(network_of(self.name(), target)?.weights())))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        Ok(Box::new(self.reconstruct(code)?))
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.reconstruct(code).map(Some)
    }
}

/// Hash of what a basis is learned from, and how. Not of the basis: its last digits differ between kinds of processors, and a
/// code should be read on all of them.
pub(super) fn checkpoint_of(training: &[Material], options: &[usize]) -> String {
    let networks = training.iter().filter_map(|material| material.network.as_ref());
    let options = options.iter().map(|&option| option as f32);
    short_hash(networks.flat_map(|network| network.weights().iter().copied()).chain(options))
}

/// The material's network of the published shape, or the reason why there is none.
pub fn network_of<'a>(model: &'static str, target: &'a Material) -> Result<&'a Nbrdf, EncodeError> {
    let missing = || EncodeError::NeedsNetwork { model, material: target.name.clone() };
    let network = target.network.as_ref().ok_or_else(missing)?;
    let found = network.hidden();
    if found != PUBLISHED_HIDDEN {
        let material = target.name.clone();
        return Err(EncodeError::Shape { model, material, expected: PUBLISHED_HIDDEN, found });
    }
    Ok(network)
}
