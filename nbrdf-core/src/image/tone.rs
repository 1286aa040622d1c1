//! Tone curves: how linear light becomes what a display shows.

use serde::{Deserialize, Serialize};

use super::clipped;

/// Radiance that the curve of E. Reinhard shows as white.
const WHITE: f32 = 4.0;

/// From linear values to displayed linear values of 0..1, channel by channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Tone {
    /// What is brighter than 1 shows white: the curve of all figures and reports.
    #[default]
    Clip,
    /// L (1 + L / 4²) / (1 + L): E. Reinhard, M. Stark, P. Shirley, J. Ferwerda, *Photographic Tone Reproduction for
    /// Digital Images*, 2002, equation 4, on every channel; 4 shows white.
    Reinhard,
    /// x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) at x = 0.6 L: the fit of the ACES reference and output transforms
    /// by K. Narkowicz, *ACES Filmic Tone Mapping Curve*, 2016, with the exposure given there.
    Filmic,
}

impl Tone {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Clip, Self::Reinhard, Self::Filmic];

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Clip => "Clip",
            Self::Reinhard => "Reinhard",
            Self::Filmic => "Filmic",
        }
    }

    /// What it does, in a sentence.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Clip => "What is brighter than 1 shows white, as in figures and reports",
            Self::Reinhard => "Highlights are compressed, 4 shows white (Reinhard and others 2002, extended)",
            Self::Filmic => "Deep shadows and soft highlights (Narkowicz' fit of ACES, 2016)",
        }
    }

    /// What is shown of a linear value: 0..1, rising; NaN and what is below 0 show 0.
    pub fn shown(self, linear: f32) -> f32 {
        // Above, the products below would be infinite, and all is white long before.
        let linear = if linear > 0.0 { linear.min(1e6) } else { 0.0 };
        clipped(match self {
            Self::Clip => linear,
            Self::Reinhard => linear * (1.0 + linear / (WHITE * WHITE)) / (1.0 + linear),
            Self::Filmic => {
                let x = 0.6 * linear;
                x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Image, Rgb};

    #[test]
    fn every_curve_rises_from_black_to_white() {
        for tone in Tone::ALL {
            let shown: Vec<f32> = (0..2000).map(|i| tone.shown(0.01 * i as f32)).collect();
            assert!(shown.windows(2).all(|pair| pair[0] <= pair[1]), "{tone:?}");
            assert!(shown.iter().all(|value| (0.0..=1.0).contains(value)));
            assert_eq!([tone.shown(0.0), tone.shown(-1.0), tone.shown(f32::NAN)], [0.0; 3], "{tone:?}");
            assert_eq!([tone.shown(f32::INFINITY), tone.shown(f32::MAX)], [1.0; 2], "{tone:?}");
        }
    }

    #[test]
    fn values_are_those_of_the_papers() {
        let is_near = |a: f32, b: f32| (a - b).abs() < 1e-6;
        assert!(is_near(Tone::Reinhard.shown(4.0), 1.0) && is_near(Tone::Reinhard.shown(1.0), 0.531_25));
        assert!(is_near(Tone::Filmic.shown(1.0), 0.6 * 1.536 / (0.6 * 2.048 + 0.14)));
        assert!(is_near(Tone::Clip.shown(0.25), 0.25));
    }

    #[test]
    fn bytes_of_the_clip_curve_are_the_displays() {
        let image = Image::new(2, 1, vec![Rgb([0.0, 0.5, 2.0]), Rgb([1.0, 0.1, 0.01])]);
        let bytes = |tone: Tone| {
            let mut bytes = Vec::new();
            image.toned_bytes_into(0.5, tone, &mut bytes);
            bytes
        };
        let mut expected = Vec::new();
        image.display_bytes_into(0.5, &mut expected);
        assert_eq!(bytes(Tone::Clip), expected);
        assert!(bytes(Tone::Reinhard)[2] < 255 && bytes(Tone::Filmic)[1] != expected[1]);
    }
}
