//! From places of the map to points of the window, and back.

use egui::{Pos2, Rect, vec2};

use crate::gui::session::MapView;
use crate::worker::Spot;

/// Room around all materials \[points\].
const MARGIN: f32 = 28.0;

/// Which part of the map is where.
pub struct Frame {
    /// In the window.
    pub rect: Rect,
    /// Points for a unit of the map.
    pub scale: f32,
    /// Middle of all materials.
    middle: [f32; 2],
    /// What is in the middle of the window's part.
    centre: [f32; 2],
}

impl Frame {
    /// Of these materials, as they are looked at.
    pub fn new(rect: Rect, spots: &[Spot], view: &MapView) -> Self {
        let range = |axis: usize| {
            let start = (f32::INFINITY, f32::NEG_INFINITY);
            spots.iter().fold(start, |(low, high), spot| (low.min(spot.at[axis]), high.max(spot.at[axis])))
        };
        let ranges = [range(0), range(1)];
        let middle = ranges.map(|(low, high)| 0.5 * (low + high));
        let room = rect.size() - vec2(2.0 * MARGIN, 2.0 * MARGIN);
        let fit = |axis: usize, room: f32| room.max(MARGIN) / (ranges[axis].1 - ranges[axis].0).max(1e-6);
        let scale = fit(0, room.x).min(fit(1, room.y)) * view.zoom;
        Self { rect, scale, middle, centre: [0, 1].map(|axis| middle[axis] + view.centre[axis]) }
    }

    /// Where a place is in the window.
    pub fn point(&self, [x, y]: [f32; 2]) -> Pos2 {
        self.rect.center() + vec2(x - self.centre[0], self.centre[1] - y) * self.scale
    }

    /// The place at a point of the window.
    pub fn place(&self, point: Pos2) -> [f32; 2] {
        let away = (point - self.rect.center()) / self.scale;
        [self.centre[0] + away.x, self.centre[1] - away.y]
    }

    /// The same, from the middle of all materials.
    pub fn offset(&self, point: Pos2) -> [f32; 2] {
        let [x, y] = self.place(point);
        [x - self.middle[0], y - self.middle[1]]
    }
}
