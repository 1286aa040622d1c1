//! All methods under all hazards: a value, a verdict and the worst example for each.

mod cell;
mod data;
mod decoded;
mod learning;
mod lists;
mod numbers;
mod paths;
mod picture;
mod returned;
mod setup;
mod tally;

pub use cell::Cell;
pub use setup::{Extent, Setup, hazards};
