//! ZNBRDF: an autoencoder over the 675 weights of a neural BRDF, with a 32-number code.
//!
//! The only crate that knows candle; tensors never leave it.

mod autoencoder;
mod checkpoint;
mod dataset;
mod inference;
mod loss;
mod model;
mod optimizer;
mod parameters;
mod probe;
mod train;

pub use autoencoder::{Architecture, Autoencoder};
pub use checkpoint::CheckpointError;
pub use train::{Progress, TrainError, TrainOptions, TrainingData, train};
