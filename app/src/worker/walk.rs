//! How a path is walked: at which time, what of it film strips show, and what is edited on the way.

use nbrdf_core::Weights;
use nbrdf_core::axis::Axis;

/// Amounts by which qualities are moved, in the order of [`Axis::ALL`].
pub type Edits = [f32; Axis::ALL.len()];

/// How a path is walked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Walk {
    /// Time along the ends, 0 at the first and 1 at the last; none where weights are chosen freely.
    pub t: Option<f32>,
    /// What film strips show.
    pub tour: Tour,
    /// Edits of points that have codes of ZNBRDF.
    pub edits: Edits,
}

impl Walk {
    /// Whether anything is to be moved, not only measured.
    pub fn is_edit(&self) -> bool {
        is_edit(&self.edits)
    }
}

/// Whether any of these moves anything.
pub(super) fn is_edit(edits: &Edits) -> bool {
    edits.iter().any(|amount| *amount != 0.0)
}

/// What a film strip shows of the ways between the ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tour {
    /// From the first end to the last.
    #[default]
    Along,
    /// The same, and half of it again on both sides.
    Beyond,
    /// Along the rim of a polygon, from corner to corner and back to the first.
    Around,
}

/// Fewest steps of a film strip.
const FEWEST: usize = 8;

impl Tour {
    /// Frames of a strip, so many that each end has its own.
    pub fn frames(self, ends: usize) -> usize {
        let spans = match self {
            Self::Along => ends.saturating_sub(1).max(1),
            // Of the whole length the ends' is one half.
            Self::Beyond => return FEWEST + 1,
            Self::Around => ends.max(1),
        };
        spans * FEWEST.div_ceil(spans) + 1
    }

    /// Where a frame is: t, or the share of the way around.
    pub fn place(self, frame: usize, ends: usize) -> f32 {
        let share = frame as f32 / (self.frames(ends) - 1) as f32;
        if self == Self::Beyond { 2.0 * share - 0.5 } else { share }
    }

    /// How far along the strip a place is, from 0 to 1.
    pub fn share(self, place: f32) -> f32 {
        if self == Self::Beyond { 0.5 * (place + 0.5) } else { place }
    }

    /// Weights of the ends at a place on the rim of their polygon, or on the spline through them.
    pub fn weights(self, place: f32, ends: usize) -> Weights {
        if self != Self::Around {
            return Weights::along_spline(place, ends);
        }
        let along = place.rem_euclid(1.0) * ends as f32;
        let corner = (along as usize).min(ends - 1);
        let within = (along - corner as f32).clamp(0.0, 1.0);
        let mut weights = vec![0.0; ends];
        weights[corner] += 1.0 - within;
        weights[(corner + 1) % ends] += within;
        Weights::normalized(weights).unwrap_or_else(|_| Weights::along_spline(0.0, ends))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_end_has_a_frame_of_its_own() {
        for ends in 2..=6 {
            for tour in [Tour::Along, Tour::Around] {
                let frames: Vec<Weights> =
                    (0..tour.frames(ends)).map(|frame| tour.weights(tour.place(frame, ends), ends)).collect();
                for end in 0..ends {
                    let is_own = |weights: &&Weights| (weights.as_slice()[end] - 1.0).abs() < 1e-4;
                    assert!(frames.iter().any(|weights| is_own(&weights)), "{tour:?} {ends} {end}: {frames:?}");
                }
            }
        }
        assert_eq!(Tour::Along.frames(2), 9);
    }

    #[test]
    fn a_tour_around_is_closed_and_one_beyond_leaves_the_ends() {
        let [first, last] = [0, Tour::Around.frames(4) - 1].map(|frame| Tour::Around.place(frame, 4));
        assert_eq!(Tour::Around.weights(first, 4), Tour::Around.weights(last, 4));
        assert_eq!(Tour::Around.weights(0.125, 4).as_slice(), [0.5, 0.5, 0.0, 0.0]);
        assert_eq!([0, 2, 8].map(|frame| Tour::Beyond.place(frame, 2)), [-0.5, 0.0, 1.5]);
        assert_eq!([-0.5, 1.5].map(|place| Tour::Beyond.share(place)), [0.0, 1.0]);
    }
}
