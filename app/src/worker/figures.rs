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
    /// Mean ΔE_ITP to A and to B.
    pub to_ends: [f64; 2],
    /// Distance of the mean colour from the segment between the ends' in u′v′.
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

    /// Against the mix and the ends.
    pub fn compare(&self, mix: &Self, [a, b]: [&Self; 2], covered: &[bool]) -> Figures {
        Figures {
            psnr: psnr(&mix.displayed, &self.displayed, covered),
            to_mix: mix.itp.distance(&self.itp, covered),
            to_ends: [a, b].map(|end| end.itp.distance(&self.itp, covered)),
            hue: distance_from_segment(self.colour, a.colour, b.colour),
        }
    }
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
        let (a, b, mix) = (seen(0.2), seen(0.6), seen(0.4));
        let figures = mix.compare(&mix, [&a, &b], &[true]);
        assert_eq!((figures.psnr, figures.to_mix), (100.0, 0.0));
        assert!(figures.to_ends.iter().all(|&distance| distance > 1.0) && figures.hue < 1e-9);
    }
}
