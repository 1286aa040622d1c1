//! What was learned: bases, and checkpoints of autoencoders.

use autoencoder::Autoencoder;
use nbrdf_core::Representation;
use nbrdf_core::representation::basis::{Basis, BasisFile};
use nbrdf_core::representation::charting::Charting;
use nbrdf_core::representation::linear_combination::LinearCombination;
use nbrdf_core::representation::optimal_sampling::OptimalSampling;
use nbrdf_core::representation::pca_tables::PcaTables;
use nbrdf_core::representation::pca_weights::PcaWeights;

use super::assert_reflects;

/// What was learned decodes a code of zeros; whether it does is its own affair, but not with a panic.
fn decodes(basis: &dyn Representation) -> bool {
    let code = nbrdf_core::Code::new(basis.name(), basis.checkpoint(), vec![0.0; basis.dim()]);
    if let Ok(decoded) = basis.decode(&code) {
        assert_reflects(decoded.as_ref());
    }
    true
}

/// A basis, whichever it says it is.
pub fn basis(bytes: &[u8]) -> bool {
    let Ok(Some(file)) = BasisFile::parse("basis.safetensors", bytes) else { return false };
    fn of<B: Basis>(name: &'static str, file: &BasisFile) -> bool {
        B::of_file(name, file).is_ok_and(|basis| decodes(&basis))
    }
    match file.name() {
        "pca_weights" => of::<PcaWeights>("pca_weights", &file),
        "pca_tables" => of::<PcaTables>("pca_tables", &file),
        "charting_2" => of::<Charting>("charting_2", &file),
        "linear_combination" => of::<LinearCombination>("linear_combination", &file),
        "optimal_sampling_5" => of::<OptimalSampling>("optimal_sampling_5", &file),
        _ => false,
    }
}

/// The checkpoint of an autoencoder.
pub fn checkpoint(bytes: &[u8]) -> bool {
    Autoencoder::parse("checkpoint.safetensors", bytes).is_ok_and(|model| decodes(&model))
}
