//! Linear pictures as display bytes.

use std::fmt;

use nbrdf_core::Image;
use nbrdf_core::image::Tone;

use super::Plates;

/// How linear light is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Showing {
    /// Brighter by so many stops.
    pub stops: f32,
    pub tone: Tone,
}

/// Display values of 0..1 as they are.
pub(super) const AS_IT_IS: Showing = Showing { stops: 0.0, tone: Tone::Clip };

/// A square picture for the display; beside the surface it is transparent.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels per side.
    pub size: usize,
    /// Red, green, blue, alpha of each pixel, multiplied by alpha, row by row from the top left.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// A linear picture, display encoded, as opaque as each pixel is.
    pub(super) fn of(linear: &Image, showing: Showing, opacity: &[f32], plates: &Plates) -> Self {
        let mut opaque = plates.take();
        linear.toned_bytes_into(showing.stops.exp2(), showing.tone, &mut opaque);
        let mut rgba = plates.take();
        rgba.clear();
        for (rgb, alpha) in opaque.chunks_exact(3).zip(opacity) {
            let of = |byte: u8| (f32::from(byte) * alpha).round() as u8;
            rgba.extend([of(rgb[0]), of(rgb[1]), of(rgb[2]), of(255)]);
        }
        plates.give_back(opaque);
        Self { size: linear.width(), rgba }
    }
}

impl fmt::Debug for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Picture({0} x {0})", self.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbrdf_core::Rgb;
    use nbrdf_core::render::Surfaces;

    #[test]
    fn corners_are_transparent_and_the_middle_is_opaque() {
        let image = Image::new(8, 8, vec![Rgb::splat(1.0); 64]);
        let shown = |tone| {
            let opacity = Surfaces::sphere(8).opacity();
            Picture::of(&image, Showing { stops: 0.0, tone }, &opacity, &Plates::default())
        };
        let picture = shown(Tone::Clip);
        assert_eq!(picture.rgba[..4], [0; 4]);
        let middle = 4 * (8 * 4 + 4);
        assert_eq!(picture.rgba[middle..middle + 4], [255; 4]);
        assert!(shown(Tone::Filmic).rgba[middle] < 255, "through another curve, white is brighter than 1");
    }
}
