//! Which part of a picture is shown: where its middle is, and how much it is enlarged.
//!
//! Places in a picture are \[across, up\], both in −1..1 over the whole picture.

use serde::{Deserialize, Serialize};

/// Most that a picture is enlarged.
pub const MAX_ZOOM: f64 = 32.0;

/// The part of a picture that is rendered, in full resolution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Written")]
pub struct Frame {
    /// How much is enlarged, 1 (the whole picture) to [`MAX_ZOOM`].
    pub zoom: f64,
    /// The place of the whole picture that is in the middle.
    pub centre: [f64; 2],
}

/// As it is in files, in any range.
#[derive(Deserialize)]
struct Written {
    zoom: f64,
    centre: [f64; 2],
}

impl From<Written> for Frame {
    fn from(Written { zoom, centre }: Written) -> Self {
        Self { zoom, centre }.within()
    }
}

impl Default for Frame {
    fn default() -> Self {
        Self::WHOLE
    }
}

impl Frame {
    /// The whole picture.
    pub const WHOLE: Self = Self { zoom: 1.0, centre: [0.0; 2] };

    /// The place of the whole picture that is seen at a place of this part.
    pub fn place(&self, [across, up]: [f64; 2]) -> [f64; 2] {
        [across / self.zoom + self.centre[0], up / self.zoom + self.centre[1]]
    }

    /// Where in this part a place of the whole picture is seen; outside −1..1 where it is not.
    pub fn seen_at(&self, [across, up]: [f64; 2]) -> [f64; 2] {
        [(across - self.centre[0]) * self.zoom, (up - self.centre[1]) * self.zoom]
    }

    /// `factor` times as large about a place of this part, which stays where it is as far as there is more to see.
    #[must_use]
    pub fn zoomed(self, factor: f64, about: [f64; 2]) -> Self {
        let place = self.place(about);
        let zoom = self.zoom * factor;
        let centre = [0, 1].map(|axis| place[axis] - about[axis] / zoom);
        Self { zoom, centre }.within()
    }

    /// Moved along with a pointer that went this far over the part.
    #[must_use]
    pub fn dragged(self, [across, up]: [f64; 2]) -> Self {
        let centre = [self.centre[0] - across / self.zoom, self.centre[1] - up / self.zoom];
        Self { centre, ..self }.within()
    }

    /// The nearest frame that is in range and shows nothing beyond the picture; the whole for numbers that are none.
    #[must_use]
    pub fn within(self) -> Self {
        if !self.zoom.is_finite() || !self.centre.iter().all(|place| place.is_finite()) {
            return Self::WHOLE;
        }
        let zoom = self.zoom.clamp(1.0, MAX_ZOOM);
        let most = 1.0 - 1.0 / zoom;
        Self { zoom, centre: self.centre.map(|place| place.clamp(-most, most)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12
    }

    #[test]
    fn what_is_under_the_pointer_stays_there() {
        let about = [0.4, -0.2];
        let near = Frame::WHOLE.zoomed(4.0, about);
        assert!(is_near(near.place(about), about) && near.zoom == 4.0);
        assert!(is_near(near.seen_at(near.place([0.3, 0.9])), [0.3, 0.9]));
        let moved = near.dragged([0.5, 0.25]);
        assert!(is_near(moved.place([0.5, 0.25]), near.place([0.0, 0.0])));
        assert!(is_near(near.zoomed(0.25, about).centre, [0.0; 2]), "nothing beyond the picture is shown");
    }

    #[test]
    fn a_frame_from_a_file_is_brought_into_range() {
        let far = Frame { zoom: 1e9, centre: [7.0, -7.0] }.within();
        assert_eq!((far.zoom, far.centre), (MAX_ZOOM, [0.96875, -0.96875]));
        assert_eq!(Frame { zoom: f64::NAN, ..Frame::WHOLE }.within(), Frame::WHOLE);
        let none: Frame = serde_json::from_str(r#"{"zoom": 0, "centre": [0.5, 0]}"#).unwrap();
        assert_eq!(none, Frame::WHOLE);
    }
}
