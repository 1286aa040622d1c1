//! Which materials are blended, and in which order.

use super::blend::Blend;
use super::polygon::{corners, into_polygon, mirrored};

/// Most materials of a blend.
pub const MOST_ENDS: usize = 6;

impl Blend {
    /// Puts a material at an end; at the end after the last it is one more, if there may be.
    pub fn choose(&mut self, end: usize, name: &str) {
        if let Some(known) = self.ends.get_mut(end) {
            name.clone_into(known);
        } else if self.ends.len() < MOST_ENDS {
            self.ends.push(name.to_owned());
            self.keep_place();
        }
    }

    /// Where a material is in the blend: its slots, from the first.
    pub fn slots_of(&self, name: &str) -> Vec<usize> {
        self.ends.iter().enumerate().filter(|(_, end)| *end == name).map(|(slot, _)| slot).collect()
    }

    /// Takes an end out; two stay.
    pub fn remove(&mut self, end: usize) {
        if self.ends.len() > 2 && end < self.ends.len() {
            self.ends.remove(end);
            self.keep_place();
        }
    }

    /// The place stays within the polygon when that gets another shape.
    fn keep_place(&mut self) {
        self.place = into_polygon(self.place, &corners(self.ends.len().max(3)));
    }

    /// The other way round; the picture in between stays where it was.
    pub fn swap(&mut self) {
        self.ends.reverse();
        self.t = 1.0 - self.t;
        self.place = mirrored(self.place, self.ends.len());
    }

    /// Moves an end to another place in the order; those between make room.
    pub fn reorder(&mut self, from: usize, to: usize) {
        if from != to && from.max(to) < self.ends.len() {
            let end = self.ends.remove(from);
            self.ends.insert(to, end);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::polygon::of;
    use super::*;

    #[test]
    fn materials_are_added_up_to_six_and_two_always_stay() {
        let mut blend = Blend::default();
        (0..10).for_each(|_| blend.choose(blend.ends.len(), "chrome"));
        assert_eq!(blend.ends.len(), MOST_ENDS);
        (0..10).for_each(|_| blend.remove(0));
        assert_eq!(blend.ends, ["chrome", "chrome"]);
    }

    #[test]
    fn all_slots_of_a_material_are_known() {
        let blend = Blend { ends: ["a", "b", "a", "a"].map(str::to_owned).to_vec(), ..Blend::default() };
        assert_eq!((blend.slots_of("a"), blend.slots_of("b")), (vec![0, 2, 3], vec![1]));
        assert!(blend.slots_of("c").is_empty());
    }

    #[test]
    fn an_end_that_is_moved_keeps_the_order_of_the_others() {
        let mut blend = Blend { ends: ["a", "b", "c", "d"].map(str::to_owned).to_vec(), ..Blend::default() };
        blend.reorder(0, 2);
        assert_eq!(blend.ends, ["b", "c", "a", "d"]);
        blend.reorder(3, 0);
        assert_eq!(blend.ends, ["d", "b", "c", "a"]);
        blend.reorder(1, 9);
        assert_eq!(blend.ends, ["d", "b", "c", "a"]);
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
}
