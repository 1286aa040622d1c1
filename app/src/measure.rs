//! Measuring: how close decoded materials come, and how good paths between materials are.

pub mod calibration;
pub mod families;
pub mod front;
pub mod guard;
pub mod linear;
pub mod manifold;
mod pairs;
pub mod path_quality;
pub mod planned;
pub mod point;
pub mod quality;
pub mod reconstruction;
pub mod sampling;
pub mod speed;
pub mod stress;
mod target;
pub mod times;
mod trust;

pub use pairs::standard_pairs;
pub use target::{Target, higher_is_better};
pub use trust::Trust;
