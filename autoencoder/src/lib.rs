//! ZNBRDF: an autoencoder over the 675 weights of a neural BRDF, with a 32-number code.
//!
//! The only crate that knows candle; tensors never leave it.

mod activation;
mod autoencoder;
mod checkpoint;
mod dataset;
mod inference;
mod known;
mod layer;
mod lobe;
mod loss;
mod model;
mod optimizer;
mod parameters;
mod probe;
mod product;
mod train;

pub use autoencoder::{Architecture, Autoencoder};
pub use checkpoint::CheckpointError;
pub use model::{DIM, MAX_DIM};
pub use train::{Progress, TrainError, TrainOptions, Trainer, TrainingData, Walk, state_of, train};

/// A lock that outlives a panic elsewhere: what it guards is overwritten before it is read.
pub(crate) fn locked<T>(mutex: &std::sync::Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
