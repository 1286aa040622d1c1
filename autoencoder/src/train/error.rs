//! Why a training ends early.

use std::path::PathBuf;

use nbrdf_core::representation::EncodeError;

use crate::checkpoint::CheckpointError;

/// Why training ended without a checkpoint.
#[derive(Debug, thiserror::Error)]
pub enum TrainError {
    /// Stopped on request; the state is saved.
    #[error("stopped at step {step}; go on with --resume (state in {})", state.display())]
    Stopped {
        /// Steps done.
        step: usize,
        /// Where the state is.
        state: PathBuf,
    },
    /// The loss is NaN or infinite.
    #[error("the loss is {loss} at step {step}: are all training materials finite?")]
    Diverged {
        /// Steps done.
        step: usize,
        /// The loss.
        loss: f64,
    },
    /// Too little to learn from.
    #[error("training needs at least two materials with networks of the published shape, found {found}")]
    TooFew {
        /// Materials found.
        found: usize,
    },
    /// A state was saved with other options or data.
    #[error(
        "{path}: expected the state of a training with {expected}, found one with {found}: ask for the same, or remove it"
    )]
    OtherRun {
        /// The state.
        path: String,
        /// Options asked for.
        expected: String,
        /// Options in the state.
        found: String,
    },
    /// A training material has no code.
    #[error(transparent)]
    Encode(#[from] EncodeError),
    /// A file could not be read or written.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// The tensor library failed (a bug, or out of memory).
    #[error("tensor library: {0}")]
    Tensor(#[from] candle_core::Error),
}
