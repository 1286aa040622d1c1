//! What was made, to be written and told of.

use std::path::PathBuf;

use nbrdf_core::{Code, Weights};
use serde_json::Value;

/// Files, and the point that they are of, where they are of one.
pub(super) struct Made {
    /// The files, and what they are to hold.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// The point of a path.
    pub point: Option<Point>,
    /// How far the files of each material are from it, where they are of materials.
    pub errors: Vec<Value>,
}

/// A point of a method's path, as it was made.
pub(super) struct Point {
    /// Weights of the ends: those of its clock where the path has one.
    pub weights: Weights,
    /// The code in place of the path's own, where that is edited.
    pub edited: Option<Code>,
}

impl Made {
    /// Files that are of no single point.
    pub const fn of_many(files: Vec<(PathBuf, Vec<u8>)>) -> Self {
        Self { files, point: None, errors: Vec::new() }
    }
}
