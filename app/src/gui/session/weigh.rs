//! The place in the polygon, by itself and by the weights it gives.

use super::Blend;
use super::polygon::{corners, into_polygon, mean_values};

impl Blend {
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
}

/// Share of one of several weights in all.
fn share_of(weights: &[f32], end: usize) -> f32 {
    weights[end] / weights.iter().sum::<f32>()
}

#[cfg(test)]
mod tests {
    use nbrdf_core::Weights;
    use proptest::prelude::*;

    use super::super::MOST_ENDS;
    use super::super::polygon::of;
    use super::*;

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
