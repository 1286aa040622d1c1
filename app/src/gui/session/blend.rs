//! What is blended, and where between.

use nbrdf_core::Weights;
use serde::{Deserialize, Serialize};

use crate::worker::Timing;

/// Marks on the scrubber from end to end.
pub const TICKS: u8 = 16;
/// Most materials of a blend.
pub const MOST_ENDS: usize = 6;
/// How far t goes beyond the ends.
pub const BEYOND: f32 = 0.5;
/// Seconds from end to end while playing.
const TRAVEL: f32 = 5.0;

/// Materials, and a place between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Blend {
    /// Names of the materials, two to [`MOST_ENDS`].
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

/// Where t moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Towards {
    /// Down to 0.
    First,
    /// Up to 1.
    Last,
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

    /// Puts a material at an end; at the end after the last it is one more, if there may be.
    pub fn choose(&mut self, end: usize, name: &str) {
        if let Some(known) = self.ends.get_mut(end) {
            name.clone_into(known);
        } else if self.ends.len() < MOST_ENDS {
            self.ends.push(name.to_owned());
        }
    }

    /// Takes an end out; two stay.
    pub fn remove(&mut self, end: usize) {
        if self.ends.len() > 2 && end < self.ends.len() {
            self.ends.remove(end);
        }
    }

    /// The other way round; the picture in between stays where it was.
    pub fn swap(&mut self) {
        self.ends.reverse();
        self.t = 1.0 - self.t;
        self.place = mirrored(self.place, self.ends.len());
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

    /// Goes to a place in the polygon; one outside is moved to its rim.
    pub fn move_to(&mut self, place: [f32; 2]) {
        let corners = corners(self.ends.len());
        self.place = into_polygon(place, &corners);
    }

    /// Starts or stops playing; at the last material it starts backwards.
    pub fn toggle_play(&mut self) {
        self.playing = match self.playing {
            Some(_) => None,
            None if self.t >= 1.0 => Some(Towards::First),
            None => Some(Towards::Last),
        };
    }

    /// Moves on while playing, back and forth.
    pub fn advance(&mut self, seconds: f32) {
        let Some(towards) = self.playing else { return };
        let way = if towards == Towards::Last { seconds } else { -seconds } / TRAVEL;
        let [low, high] = self.range();
        self.t = (self.t + way).clamp(low, high);
        if self.t <= low {
            self.playing = Some(Towards::Last);
        } else if self.t >= high {
            self.playing = Some(Towards::First);
        }
    }

    /// Whether the place lies beyond the ends.
    pub fn is_outside(&self) -> bool {
        !self.is_polygon() && !(0.0..=1.0).contains(&self.t)
    }
}

/// Corners of the polygon, the first on top, clockwise; +y is up.
pub fn corners(count: usize) -> Vec<[f32; 2]> {
    let angle = |corner: usize| std::f32::consts::TAU * corner as f32 / count as f32;
    (0..count).map(|corner| [angle(corner).sin(), angle(corner).cos()]).collect()
}

/// Where a place comes to lie when the corners are listed backwards.
fn mirrored([x, y]: [f32; 2], count: usize) -> [f32; 2] {
    // Reversed, corner k takes the place of corner n − 1 − k: a reflection about the axis at half of n − 1 steps.
    let axis = std::f32::consts::TAU * (count as f32 - 1.0) / count as f32;
    let (sin, cos) = axis.sin_cos();
    [-x * cos + y * sin, x * sin + y * cos]
}

/// Weights of corners for a place within (M. S. Floater, *Mean value coordinates*, 2003): smooth, exact at corners and
/// straight along edges.
fn mean_values(place: [f32; 2], corners: &[[f32; 2]]) -> Vec<f32> {
    let count = corners.len();
    let rays: Vec<[f64; 2]> = corners.iter().map(|c| [0, 1].map(|i| f64::from(c[i]) - f64::from(place[i]))).collect();
    let length = |k: usize| rays[k][0].hypot(rays[k][1]);
    let one_hot = |at: &[(usize, f64)]| {
        let mut weights = vec![0.0; count];
        at.iter().for_each(|&(k, weight)| weights[k] = weight as f32);
        weights
    };
    let mut tangents = Vec::with_capacity(count);
    for k in 0..count {
        let next = (k + 1) % count;
        if length(k) < 1e-6 {
            return one_hot(&[(k, 1.0)]);
        }
        let area = rays[k][0] * rays[next][1] - rays[k][1] * rays[next][0];
        let cosine = rays[k][0] * rays[next][0] + rays[k][1] * rays[next][1];
        if area.abs() < 1e-6 && cosine <= 0.0 {
            return one_hot(&[(k, length(next)), (next, length(k))]);
        }
        tangents.push((length(k) * length(next) - cosine) / area);
    }
    let weight = |k: usize| ((tangents[(k + count - 1) % count] + tangents[k]) / length(k)) as f32;
    // Clockwise corners have negative areas.
    (0..count).map(|k| weight(k).abs()).collect()
}

/// The place itself, or the nearest one on the rim.
fn into_polygon(place: [f32; 2], corners: &[[f32; 2]]) -> [f32; 2] {
    let edges = (0..corners.len()).map(|k| (corners[k], corners[(k + 1) % corners.len()]));
    let is_inside =
        |([ax, ay], [bx, by]): ([f32; 2], [f32; 2])| (bx - ax) * (place[1] - ay) - (by - ay) * (place[0] - ax) <= 0.0;
    if edges.clone().all(is_inside) {
        return place;
    }
    let onto = |([ax, ay], [bx, by]): ([f32; 2], [f32; 2])| {
        let (dx, dy) = (bx - ax, by - ay);
        let s = (((place[0] - ax) * dx + (place[1] - ay) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        [ax + s * dx, ay + s * dy]
    };
    let distance = |to: &[f32; 2]| (to[0] - place[0]).hypot(to[1] - place[1]);
    edges.map(onto).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(place)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn of(count: usize) -> Blend {
        let ends = (0..count).map(|end| letter(end).to_string()).collect();
        Blend { ends, way: Way::Polygon, ..Blend::default() }
    }

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

    #[test]
    fn playing_turns_round_at_the_ends() {
        let mut blend = Blend { t: 0.9, ..Blend::default() };
        blend.toggle_play();
        blend.advance(1.0);
        assert_eq!((blend.t, blend.playing), (1.0, Some(Towards::First)));
        blend.advance(100.0);
        assert_eq!((blend.t, blend.playing), (0.0, Some(Towards::Last)));
    }

    #[test]
    fn swapping_keeps_the_picture() {
        let mut blend = Blend { t: 0.25, ..Blend::default() };
        blend.swap();
        assert_eq!((blend.ends[0].as_str(), blend.t), ("blue-acrylic", 0.75));
        for count in 3..=MOST_ENDS {
            let mut blend = Blend { place: [0.2, -0.1], ..of(count) };
            let mut before = blend.weights().as_slice().to_vec();
            blend.swap();
            before.reverse();
            let after = blend.weights();
            assert!(after.as_slice().iter().zip(&before).all(|(a, b)| (a - b).abs() < 1e-5), "{before:?} {after:?}");
        }
    }

    #[test]
    fn materials_are_added_up_to_six_and_two_always_stay() {
        let mut blend = Blend::default();
        (0..10).for_each(|_| blend.choose(blend.ends.len(), "chrome"));
        assert_eq!(blend.ends.len(), MOST_ENDS);
        (0..10).for_each(|_| blend.remove(0));
        assert_eq!(blend.ends, ["chrome", "chrome"]);
    }

    proptest! {
        #[test]
        fn weights_in_a_polygon_sum_to_one_are_positive_and_find_their_place(
            x in -2.0..2.0f32, y in -2.0..2.0f32, count in 3usize..=MOST_ENDS,
        ) {
            let mut blend = of(count);
            blend.move_to([x, y]);
            let weights = blend.weights();
            let sum: f32 = weights.as_slice().iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-4 && weights.as_slice().iter().all(|&w| w >= 0.0), "{weights:?}");
            let found = weights.as_slice().iter().zip(corners(count)).fold([0.0; 2], |[x, y], (w, c)| {
                [x + w * c[0], y + w * c[1]]
            });
            // Mean value coordinates reproduce linear functions.
            prop_assert!((found[0] - blend.place[0]).hypot(found[1] - blend.place[1]) < 1e-3, "{found:?} {:?}", blend.place);
        }
    }
}
