//! How the way between the materials is walked, and where on it one is.

use super::Blend;
use super::polygon::{corners, on_rim, rim_of};
use crate::worker::{Tour, Walk};

impl Blend {
    /// How paths are walked.
    pub fn walk(&self) -> Walk {
        Walk { t: (!self.is_polygon()).then_some(self.t), tour: self.tour(), edits: self.edits }
    }

    /// What film strips show.
    pub fn tour(&self) -> Tour {
        match (self.is_polygon(), self.is_beyond) {
            (true, _) => Tour::Around,
            (false, true) => Tour::Beyond,
            (false, false) => Tour::Along,
        }
    }

    /// Where on the tour this is; none off the rim of a polygon.
    pub fn on_tour(&self) -> Option<f32> {
        if !self.is_polygon() {
            return Some(self.t);
        }
        let (around, distance) = on_rim(self.place, &corners(self.ends.len()));
        (distance < 1e-3).then_some(around)
    }

    /// Goes to a place on the tour.
    pub fn tour_to(&mut self, place: f32) {
        if self.is_polygon() {
            self.playing = None;
            self.place = rim_of(place, &corners(self.ends.len()));
        } else {
            self.go_to(place);
        }
    }
}
