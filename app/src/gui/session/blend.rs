//! What is blended, and where between.

use nbrdf_core::Weights;
use nbrdf_core::axis::Axis;
use serde::{Deserialize, Serialize};

use super::polygon::{corners, into_polygon, mean_values, on_rim, rim_of};
use crate::worker::{Edits, Timing, Tour, Walk};

/// Marks on the scrubber from end to end.
pub const TICKS: u8 = 16;
/// How far t goes beyond the ends.
pub const BEYOND: f32 = 0.5;
/// Seconds from end to end while playing.
const TRAVEL: f32 = 5.0;

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

    /// How paths are walked.
    pub fn walk(&self) -> Walk {
        Walk { t: (!self.is_polygon()).then_some(self.t), tour: self.tour(), edits: self.edits, is_measured: false }
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

    /// Goes to a place in the polygon; one outside is moved to its rim.
    pub fn move_to(&mut self, place: [f32; 2]) {
        self.playing = None;
        self.place = into_polygon(place, &corners(self.ends.len()));
    }

    /// Goes towards or away from a corner, until its weight is `share` (0 to 1); the others share the rest, of three
    /// ends as before.
    pub fn weigh(&mut self, end: usize, share: f32) {
        let corners = corners(self.ends.len());
        let Some(&corner) = corners.get(end).filter(|_| share.is_finite()) else { return };
        let away = [self.place[0] - corner[0], self.place[1] - corner[1]];
        let length = away[0].hypot(away[1]);
        // At the corner itself the way leads through the middle.
        let way = if length > 1e-3 { away.map(|v| v / length) } else { corner.map(|v| -v) };
        let at = |distance: f32| [corner[0] + distance * way[0], corner[1] + distance * way[1]];
        let weight = |distance: f32| {
            let place = at(distance);
            let [x, y] = into_polygon(place, &corners);
            let is_inside = (x - place[0]).hypot(y - place[1]) < 1e-5;
            // Beyond the far rim nothing is left.
            if is_inside { share_of(&mean_values(place, &corners), end) } else { -1.0 }
        };
        let (mut near, mut far) = (0.0, 2.0);
        for _ in 0..30 {
            let middle = 0.5 * (near + far);
            if weight(middle) >= share { near = middle } else { far = middle }
        }
        self.move_to(at(near));
    }

    /// Starts or stops playing; at the last material it starts backwards.
    pub fn toggle_play(&mut self) {
        self.playing = match self.playing {
            Some(_) => None,
            None if self.t >= 1.0 && !self.is_polygon() => Some(Towards::First),
            None => Some(Towards::Last),
        };
    }

    /// Moves on while playing: back and forth on a path, around the rim of a polygon.
    pub fn advance(&mut self, seconds: f32) {
        let Some(towards) = self.playing else { return };
        let way = if towards == Towards::Last { seconds } else { -seconds } / TRAVEL;
        if self.is_polygon() {
            let corners = corners(self.ends.len());
            self.place = rim_of(on_rim(self.place, &corners).0 + way, &corners);
            return;
        }
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

/// Share of one of several weights in all.
fn share_of(weights: &[f32], end: usize) -> f32 {
    weights[end] / weights.iter().sum::<f32>()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::MOST_ENDS;
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
    fn a_weight_that_is_typed_is_reached_and_of_three_the_others_keep_their_ratio() {
        let mut blend = Blend { place: [0.1, 0.2], ..of(3) };
        let before = blend.weights();
        blend.weigh(0, 0.8);
        let after = blend.weights();
        let ratio = |weights: &Weights| weights.as_slice()[1] / weights.as_slice()[2];
        assert!((after.as_slice()[0] - 0.8).abs() < 1e-3, "{after:?}");
        assert!((ratio(&before) - ratio(&after)).abs() < 1e-2, "{before:?} {after:?}");
        for (end, share) in [(2, 1.0), (2, 0.25), (4, 0.5), (1, 0.0), (9, 0.5)] {
            let mut blend = of(5);
            blend.weigh(end, share);
            let found = blend.weights().as_slice().get(end).copied().unwrap_or(share);
            assert!((found - share).abs() < 2e-3, "{end} {share}: {found}");
        }
    }

    #[test]
    fn playing_a_polygon_goes_around_its_rim() {
        let mut blend = of(4);
        blend.tour_to(0.125);
        assert_eq!(blend.on_tour().map(|place| (place * 1e4).round()), Some(1250.0));
        blend.t = 1.0;
        blend.toggle_play();
        (0..40).for_each(|_| blend.advance(0.1));
        assert!((blend.on_tour().unwrap() - 0.925).abs() < 1e-3, "{:?}", blend.on_tour());
        blend.move_to([0.0, 0.0]);
        assert_eq!((blend.on_tour(), blend.playing), (None, None));
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
