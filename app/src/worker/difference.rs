//! How two spheres differ, pixel by pixel, as a heat map.

use nbrdf_core::metric::delta_e_itp_map;
use nbrdf_core::{Image, Rgb};
use rayon::prelude::*;

use super::picture::{AS_IT_IS, Picture};
use super::request::Closeup;
use super::sets::Sight;
use super::studio::Studio;
use super::{Answer, Card, Request, Scale};
use crate::report::heat::heat;

/// Round numbers that a scale may end at \[ΔE_ITP\].
const TOPS: [u16; 9] = [1, 2, 5, 10, 20, 50, 100, 200, 500];

/// The difference of two cards in ΔE_ITP as they are displayed, through the tone curve that is shown; one unit is just
/// noticeable.
#[derive(Debug)]
pub struct Difference {
    /// Of which cards.
    pub cards: [Card; 2],
    /// The heat map.
    pub picture: Picture,
    /// Where its colours end.
    pub top: u16,
    /// Mean over the sphere.
    pub mean: f32,
    /// Of the pixel that differs most.
    pub largest: f32,
}

/// What the map shows, before it is coloured.
struct Figures {
    top: u16,
    mean: f32,
    largest: f32,
}

impl Studio {
    /// Sends the difference of the two cards that are looked at, if it is asked for and both pictures are there.
    pub fn differ(&self, request: &Request, sight: &Sight, image: impl Fn(&Self, Card) -> Option<Image>) {
        let Some(Closeup { cards, scale: Some(scale) }) = request.closeup else { return };
        if let [Some(first), Some(second)] = cards.map(|card| image(self, card)) {
            let gain = request.exposure.exp2();
            let shown = |pixel: Rgb| pixel.map(|linear| request.tone.shown(linear * gain));
            let [first, second] = [first, second].map(|image| image.map(shown));
            let map = delta_e_itp_map(&first, &second);
            let Figures { top, mean, largest } = figures(&map, &sight.surfaces.covered(), scale);
            let colours = map.par_iter().map(|&value| heat(f64::from(value) / f64::from(top)));
            let colours: Vec<Rgb> = colours.collect();
            let colours = Image::new(first.width(), first.height(), colours);
            let picture = Picture::of(&colours, AS_IT_IS, &sight.opacity, &self.office.plates);
            self.office.say(Answer::Difference(Difference { cards, picture, top, mean, largest }));
        }
    }
}

fn figures(map: &[f32], covered: &[bool], scale: Scale) -> Figures {
    let of_sphere = || map.iter().zip(covered).filter(|(_, on)| **on).map(|(value, _)| *value);
    let (sum, count) = of_sphere().fold((0.0, 0_u32), |(sum, count), value| (sum + f64::from(value), count + 1));
    let largest = of_sphere().fold(0.0, f32::max);
    let whole = || TOPS.into_iter().find(|&top| f32::from(top) >= largest).unwrap_or(u16::MAX);
    let top = match scale {
        Scale::Whole => whole(),
        Scale::UpTo(top) => top.max(1),
    };
    Figures { top, mean: (sum / f64::from(count.max(1))) as f32, largest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_ends_at_a_round_number_and_what_is_off_the_sphere_does_not_count() {
        let found = figures(&[1.0, 11.0, 400.0], &[true, true, false], Scale::Whole);
        assert_eq!((found.top, found.mean, found.largest), (20, 6.0, 11.0));
        assert_eq!(figures(&[1.0, 11.0, 400.0], &[true; 3], Scale::UpTo(5)).top, 5);
        assert_eq!(figures(&[], &[], Scale::Whole).top, 1);
    }
}
