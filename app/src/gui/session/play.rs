//! How t moves by itself.

use super::Blend;
use super::polygon::{corners, on_rim, rim_of};

/// Seconds from end to end.
const TRAVEL: f32 = 5.0;

/// Where t moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Towards {
    /// Down to 0.
    First,
    /// Up to 1.
    Last,
}

impl Blend {
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
}

#[cfg(test)]
mod tests {
    use super::super::polygon::of;
    use super::*;

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
}
