//! What is blended, and where between.

use nbrdf_core::Weights;
use nbrdf_core::axis::Axis;
use serde::{Deserialize, Serialize};

use super::Towards;
use super::polygon::{corners, mean_values};
use crate::worker::{Edits, Timing};

/// Marks on the scrubber from end to end.
pub const TICKS: u8 = 16;
/// How far t goes beyond the ends.
pub const BEYOND: f32 = 0.5;

/// Materials, and a place between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Blend {
    /// Names of the materials, two to [`MOST_ENDS`](super::MOST_ENDS).
    pub ends: Vec<String>,
    /// How they are walked between.
    pub way: Way,
    /// Where on the path: 0 is the first material, 1 the last.
    pub t: f32,
    /// Where in the polygon: +x right, +y up, its corners at distance 1 from the middle.
    pub place: [f32; 2],
    /// How t runs.
    pub timing: Timing,
    /// Whether t may leave 0..1.
    pub is_beyond: bool,
    /// How far qualities are moved, in the order of [`Axis::ALL`], −1 to 1 each.
    pub edits: Edits,
    /// Whether t moves by itself, and which way.
    #[serde(skip)]
    pub playing: Option<Towards>,
}

/// How several materials are walked between.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Way {
    /// From one to the next, along a smooth curve.
    #[default]
    Keys,
    /// Freely, in a polygon with one at each corner.
    Polygon,
}

impl Default for Blend {
    fn default() -> Self {
        Self {
            ends: ["gold-paint", "blue-acrylic"].map(str::to_owned).to_vec(),
            way: Way::Keys,
            t: 0.5,
            place: [0.0; 2],
            timing: Timing::Straight,
            is_beyond: false,
            edits: [0.0; Axis::ALL.len()],
            playing: None,
        }
    }
}

/// The letter of an end: A, B, ...
pub fn letter(end: usize) -> char {
    char::from(b'A' + (end % 26) as u8)
}

impl Blend {
    /// The weights of the ends here.
    pub fn weights(&self) -> Weights {
        if self.is_polygon() {
            let corners = corners(self.ends.len());
            let found = Weights::normalized(mean_values(self.place, &corners));
            return found.unwrap_or_else(|_| Weights::along_spline(0.0, self.ends.len()));
        }
        Weights::along_spline(self.t, self.ends.len())
    }

    /// Whether the place in the polygon counts, not t.
    pub fn is_polygon(&self) -> bool {
        self.way == Way::Polygon && self.ends.len() > 2
    }

    /// Lowest and highest t.
    pub fn range(&self) -> [f32; 2] {
        if self.is_beyond { [-BEYOND, 1.0 + BEYOND] } else { [0.0, 1.0] }
    }

    /// Goes to the next tick after (`+1`) or before (`-1`) the present place, and so on.
    pub fn step(&mut self, ticks: i8) {
        let place = self.t * f32::from(TICKS);
        let from = if ticks > 0 { (place + 1e-3).floor() } else { (place - 1e-3).ceil() };
        self.go_to((from + f32::from(ticks)) / f32::from(TICKS));
    }

    /// Goes to a place on the path.
    pub fn go_to(&mut self, t: f32) {
        let [low, high] = self.range();
        self.playing = None;
        self.t = t.clamp(low, high);
    }

    /// Where a key lies on the path, 0 to 1.
    pub fn key(&self, end: usize) -> f32 {
        end as f32 / (self.ends.len() - 1).max(1) as f32
    }

    /// Whether the place lies beyond the ends.
    pub fn is_outside(&self) -> bool {
        !self.is_polygon() && !(0.0..=1.0).contains(&self.t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_from_tick_to_tick_and_stop_at_the_ends() {
        let mut blend = Blend { t: 0.52, ..Blend::default() };
        blend.step(1);
        assert_eq!(blend.t, 9.0 / 16.0);
        blend.step(-1);
        assert_eq!(blend.t, 0.5);
        blend.step(-100);
        assert_eq!(blend.t, 0.0);
        blend.is_beyond = true;
        blend.step(-100);
        assert_eq!((blend.t, blend.is_outside()), (-BEYOND, true));
    }
}
