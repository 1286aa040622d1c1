//! Which place of the spheres is looked at closely.

use serde::{Deserialize, Serialize};

/// A place of the spheres, and what is looked at there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pick {
    /// In the whole picture, half its width from the middle: +x right, +y up.
    pub at: Option<[f32; 2]>,
    /// Which lamp of the light; none for the brightest.
    pub lamp: Option<usize>,
    /// Whether dragging picks instead of moving the light.
    #[serde(skip)]
    pub is_picking: bool,
}

impl Pick {
    /// Picks a place; one outside the picture is moved to its rim.
    pub fn put(&mut self, place: [f64; 2]) {
        self.at = Some(place.map(|along| along.clamp(-1.0, 1.0) as f32));
    }

    /// Picks nothing any more.
    pub fn clear(&mut self) {
        (self.at, self.is_picking) = (None, false);
    }
}
