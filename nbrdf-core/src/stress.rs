//! Where methods fail: hazards, what is measured under each, and from which value on a method holds, degrades or fails.
//!
//! Each kind of hazard has a file with a list; what runs all methods through them is `nbrdf stress`.

pub mod damage;
pub mod directions;
mod hazard;
pub mod numbers;
pub mod samples;

pub use hazard::{Group, Hazard, Verdict};
