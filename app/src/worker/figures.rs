//! How a sphere compares with the exact linear mix of the ends, as it is seen: under this light, at this exposure.

use nbrdf_core::Image;
use nbrdf_core::metric::{ItpImage, distance_from_segment, mean_chromaticity, psnr};

/// Figures of one sphere, from pictures of the size of the reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// PSNR of the displayed picture against the linear mix \[dB\]; 100 for the same picture.
    pub psnr: f64,
    /// Mean ΔE_ITP to the linear mix; about 1 is just noticeable.
    pub to_mix: f64,
    /// The nearest end (of an end, the nearest other one) and the mean ΔE_ITP to it.
    pub nearest: (usize, f64),
    /// How far the mean colour lies from mixtures of the ends' in u′v′: from the segment, triangle or polygon of theirs.
    pub hue: f64,
}

/// A picture as it is seen: displayed, in ITP, and its mean colour. Another may take its place in the same memory.
#[derive(Default)]
pub(super) struct Seen {
    displayed: Image,
    itp: ItpImage,
    colour: [f64; 2],
}

impl Seen {
    /// Looks at a linear picture times `gain`.
    pub fn look(&mut self, linear: &Image, gain: f32, covered: &[bool]) {
        linear.displayed_into(gain, &mut self.displayed);
        self.itp.renew(linear, gain);
        self.colour = mean_chromaticity(linear, gain, covered);
    }

    /// Mean ΔE_ITP to another picture.
    pub fn distance(&self, other: &Self, covered: &[bool]) -> f64 {
        self.itp.distance(&other.itp, covered)
    }

    /// Against the mix and the ends; `own` is the end that this is, if it is one.
    pub fn compare(&self, mix: &Self, ends: &[Self], own: Option<usize>, covered: &[bool]) -> Figures {
        let others = ends.iter().enumerate().filter(|(end, _)| Some(*end) != own);
        let distances = others.map(|(end, seen)| (end, seen.itp.distance(&self.itp, covered)));
        Figures {
            psnr: psnr(&mix.displayed, &self.displayed, covered),
            to_mix: mix.itp.distance(&self.itp, covered),
            nearest: distances.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0)),
            hue: distance_from_mixtures(self.colour, ends),
        }
    }
}

/// Of a colour from all mixtures of others.
fn distance_from_mixtures(colour: [f64; 2], ends: &[Seen]) -> f64 {
    let edges = ends.iter().enumerate().flat_map(|(a, first)| ends[..a].iter().map(move |second| (first, second)));
    let mut nearest = f64::INFINITY;
    for (a, b) in edges {
        if ends.iter().any(|c| is_within(colour, [a.colour, b.colour, c.colour])) {
            return 0.0;
        }
        nearest = nearest.min(distance_from_segment(colour, a.colour, b.colour));
    }
    nearest
}

/// Whether a place is inside a triangle; one without area has no inside.
fn is_within(p: [f64; 2], [a, b, c]: [[f64; 2]; 3]) -> bool {
    let side = |from: [f64; 2], to: [f64; 2], at: [f64; 2]| {
        (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
    };
    let area = side(a, b, c);
    area != 0.0 && [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| side(from, to, p) * area.signum() >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbrdf_core::Rgb;

    #[test]
    fn the_mix_itself_has_the_best_figures() {
        let seen = |value: f32| {
            let mut seen = Seen::default();
            // Twice the light, half the gain.
            seen.look(&Image::new(1, 1, vec![Rgb::splat(2.0 * value)]), 0.5, &[true]);
            seen
        };
        let (ends, mix) = ([seen(0.2), seen(0.6)], seen(0.4));
        let figures = mix.compare(&mix, &ends, None, &[true]);
        assert_eq!((figures.psnr, figures.to_mix), (100.0, 0.0));
        assert!(figures.nearest.1 > 1.0 && figures.hue < 1e-9);
        assert_eq!(ends[1].compare(&mix, &ends, Some(1), &[true]).nearest.0, 0, "an end is not compared with itself");
    }

    #[test]
    fn a_colour_between_three_others_makes_no_detour() {
        let seen = |colour| Seen { colour, ..Seen::default() };
        let ends = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(seen);
        assert_eq!(distance_from_mixtures([0.2, 0.3], &ends), 0.0);
        assert!((distance_from_mixtures([0.5, -0.25], &ends) - 0.25).abs() < 1e-12);
        assert!((distance_from_mixtures([0.5, 0.25], &ends[..2]) - 0.25).abs() < 1e-12);
    }
}
