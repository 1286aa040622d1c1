//! How a command fails, and with which exit code.

use autoencoder::{CheckpointError, TrainError};
use nbrdf_core::library::refit::RefitError;
use nbrdf_core::library::{LibraryError, UnknownMaterial};
use nbrdf_core::measured::MeasuredError;
use nbrdf_core::nbrdf::file::ReadError;
use nbrdf_core::path::{PathError, WeightsError};
use nbrdf_core::plan::PlanError;
use nbrdf_core::render::environment::EnvironmentError;
use nbrdf_core::representation::charting::ChartingError;
use nbrdf_core::representation::measured_tables::BasisError;
use nbrdf_core::representation::pca::PcaError;
use nbrdf_core::representation::{DecodeError, EncodeError};
use nbrdf_core::scene::SceneError;
use nbrdf_core::tensor_file::TensorFileError;

/// A failure that is the user's to mend, with the exit code that says which kind it is.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A name or value on the command line makes no sense: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// A file is not what it should be: exit code 3.
    #[error("{0}")]
    InvalidFile(String),
}

/// Exit code of an error: 2 usage, 3 invalid file, 1 anything else.
pub fn exit_code(error: &anyhow::Error) -> u8 {
    for cause in error.chain() {
        if let Some(failure) = cause.downcast_ref::<Failure>() {
            return match failure {
                Failure::Usage(_) => 2,
                Failure::InvalidFile(_) => 3,
            };
        }
        let usage = cause.is::<UnknownMaterial>() || cause.is::<WeightsError>();
        let invalid = cause.downcast_ref().is_some_and(invalid_library)
            || cause.is::<ReadError>()
            || cause.is::<MeasuredError>()
            || cause.is::<DecodeError>()
            || cause.is::<EncodeError>()
            || cause.is::<PathError>()
            || cause.is::<BasisError>()
            || cause.is::<PcaError>()
            || cause.is::<ChartingError>()
            || cause.is::<EnvironmentError>()
            || cause.is::<SceneError>()
            || matches!(cause.downcast_ref(), Some(PlanError::Encode(_)))
            || cause.downcast_ref().is_some_and(invalid_checkpoint)
            || cause.downcast_ref().is_some_and(invalid_tensors)
            || matches!(cause.downcast_ref(), Some(RefitError::NothingToLearnFrom { .. } | RefitError::Library(_)))
            || cause.downcast_ref().is_some_and(invalid_training);
        if usage {
            return 2;
        }
        if invalid {
            return 3;
        }
    }
    1
}

fn invalid_library(error: &LibraryError) -> bool {
    match error {
        LibraryError::Io { problem, .. } => is_named_wrongly(problem),
        _ => true,
    }
}

fn invalid_checkpoint(error: &CheckpointError) -> bool {
    match error {
        CheckpointError::File(error) => invalid_tensors(error),
        CheckpointError::Tensor(_) => false,
    }
}

fn invalid_tensors(error: &TensorFileError) -> bool {
    match error {
        TensorFileError::Invalid { .. } => true,
        TensorFileError::Io { source, .. } => is_named_wrongly(source),
    }
}

/// Whether a path leads to no file that can be read.
fn is_named_wrongly(error: &std::io::Error) -> bool {
    use std::io::ErrorKind::{IsADirectory, NotFound, PermissionDenied};
    matches!(error.kind(), IsADirectory | NotFound | PermissionDenied)
}

/// What to do about an error whose message does not say so: where a path leads to no file.
pub fn advice(error: &anyhow::Error) -> Option<&'static str> {
    let of_system = error.chain().find_map(|cause| cause.downcast_ref::<std::io::Error>())?;
    is_named_wrongly(of_system).then_some("check the path")
}

fn invalid_training(error: &TrainError) -> bool {
    match error {
        TrainError::OtherRun { .. } | TrainError::TooFew { .. } | TrainError::Encode(_) => true,
        TrainError::Checkpoint(error) => invalid_checkpoint(error),
        _ => false,
    }
}
