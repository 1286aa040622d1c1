//! Names beside points, where there is room.

use std::fmt::{self, Write};

use super::{Panel, Spot};
use crate::report::svg::escaped;

/// How wide a letter of a name is, and how high a line.
const LETTER: f64 = 6.3;
const LINE: f64 = 13.0;

/// A rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

impl Frame {
    fn overlaps(&self, other: &Self) -> bool {
        self.x < other.x + other.width
            && other.x < self.x + self.width
            && self.y < other.y + other.height
            && other.y < self.y + self.height
    }

    fn holds(&self, other: &Self) -> bool {
        other.x >= self.x
            && other.y >= self.y
            && other.x + other.width <= self.x + self.width
            && other.y + other.height <= self.y + self.height
    }
}

/// Labels where there is room, those of the front first: right of the point, left, above, below.
pub(super) fn labels(
    out: &mut String,
    panel: &Panel,
    shown: &[&Spot],
    place: &dyn Fn(&Spot) -> [f64; 2],
    plot: Frame,
) -> fmt::Result {
    let mark = |spot: &Spot| {
        let [x, y] = place(spot);
        Frame { x: x - spot.size, y: y - spot.size, width: 2.0 * spot.size, height: 2.0 * spot.size }
    };
    let on_front = panel.front.iter().filter_map(|&i| panel.spots.get(i));
    let corners: Vec<[f64; 2]> = on_front.filter(|spot| spot.is_shown()).map(place).collect();
    let steps = corners.windows(2).flat_map(|pair| step(pair[0], pair[1]));
    let mut taken: Vec<Frame> = shown.iter().map(|spot| mark(spot)).chain(steps).collect();
    let is_front =
        |spot: &Spot| panel.front.iter().any(|&i| panel.spots.get(i).is_some_and(|own| std::ptr::eq(own, spot)));
    let (front, rest): (Vec<&Spot>, Vec<&Spot>) = shown.iter().copied().partition(|spot| is_front(spot));
    for (spot, class) in front.into_iter().map(|s| (s, "name")).chain(rest.into_iter().map(|s| (s, "name quiet"))) {
        let own = mark(spot);
        let width = LETTER * spot.label.chars().count() as f64;
        let [x, y] = place(spot);
        let beside = [
            (own.x + own.width + 3.0, y - 0.5 * LINE),
            (own.x + own.width + 1.0, own.y - LINE + 1.0),
            (own.x - 3.0 - width, y - 0.5 * LINE),
            (x - 0.5 * width, own.y - LINE - 1.0),
            (x - 0.5 * width, own.y + own.height + 1.0),
            (own.x + own.width + 1.0, own.y + own.height - 3.0),
            (own.x - 1.0 - width, own.y - LINE + 3.0),
            (own.x - 1.0 - width, own.y + own.height - 3.0),
        ];
        let frames = beside.map(|(x, y)| Frame { x, y, width, height: LINE });
        let free =
            frames.into_iter().find(|frame| plot.holds(frame) && !taken.iter().any(|other| frame.overlaps(other)));
        if let Some(frame) = free {
            taken.push(frame);
            writeln!(
                out,
                "<text class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                frame.x,
                frame.y + 0.8 * LINE,
                escaped(&spot.label)
            )?;
        }
    }
    Ok(())
}

/// Where the front goes from one corner to the next: across, then down.
fn step([x, y]: [f64; 2], [to_x, to_y]: [f64; 2]) -> [Frame; 2] {
    [
        Frame { x: x.min(to_x), y: y - 1.0, width: (to_x - x).abs(), height: 2.0 },
        Frame { x: to_x - 1.0, y: y.min(to_y), width: 2.0, height: (to_y - y).abs() },
    ]
}
