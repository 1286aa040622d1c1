//! How a sphere compares with the exact linear mix of the ends, as it is seen: under this light, at this exposure.

use nbrdf_core::Image;
use nbrdf_core::metric::{ItpImage, hue_excursion, psnr};

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

/// A picture, displayed and in ITP.
pub(super) struct Seen {
    linear: Image,
    displayed: Image,
    itp: ItpImage,
}

impl Seen {
    pub fn new(linear: Image) -> Self {
        Self { displayed: linear.displayed(), itp: ItpImage::new(&linear), linear }
    }

    /// Against the mix and the ends.
    pub fn compare(&self, mix: &Self, [a, b]: [&Self; 2], covered: &[bool]) -> Figures {
        let walk = [a.linear.clone(), self.linear.clone(), b.linear.clone()];
        Figures {
            psnr: psnr(&mix.displayed, &self.displayed, covered),
            to_mix: mix.itp.distance(&self.itp, covered),
            to_ends: [a, b].map(|end| end.itp.distance(&self.itp, covered)),
            hue: hue_excursion(&walk, covered),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbrdf_core::Rgb;

    #[test]
    fn the_mix_itself_has_the_best_figures() {
        let seen = |value: f32| Seen::new(Image::new(1, 1, vec![Rgb::splat(value)]));
        let (a, b, mix) = (seen(0.2), seen(0.6), seen(0.4));
        let figures = mix.compare(&mix, [&a, &b], &[true]);
        assert_eq!((figures.psnr, figures.to_mix), (100.0, 0.0));
        assert!(figures.to_ends.iter().all(|&distance| distance > 1.0) && figures.hue < 1e-9);
    }
}
