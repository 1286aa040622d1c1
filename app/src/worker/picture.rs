//! Linear pictures as display bytes.

use std::fmt;

use nbrdf_core::Image;

use super::Plates;

/// A square picture for the display; off the sphere it is transparent.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels per side.
    pub size: usize,
    /// Red, green, blue, alpha of each pixel, multiplied by alpha, row by row from the top left.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// A linear picture of a sphere, brighter by so many stops, display encoded; its rim fades out over a pixel.
    pub(super) fn of(linear: &Image, stops: f32, plates: &Plates) -> Self {
        let size = linear.width();
        let middle = size as f32 / 2.0;
        let alpha = |pixel: usize| {
            let (x, y) = ((pixel % size) as f32 + 0.5 - middle, (pixel / size) as f32 + 0.5 - middle);
            (0.99 * middle - x.hypot(y)).clamp(0.0, 1.0)
        };
        let mut opaque = plates.take();
        linear.display_bytes_into(stops.exp2(), &mut opaque);
        let mut rgba = plates.take();
        rgba.clear();
        for (pixel, rgb) in opaque.chunks_exact(3).enumerate() {
            let alpha = alpha(pixel);
            let of = |byte: u8| (f32::from(byte) * alpha).round() as u8;
            rgba.extend([of(rgb[0]), of(rgb[1]), of(rgb[2]), of(255)]);
        }
        plates.give_back(opaque);
        Self { size, rgba }
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

    #[test]
    fn corners_are_transparent_and_the_middle_is_opaque() {
        let picture = Picture::of(&Image::new(8, 8, vec![Rgb::splat(1.0); 64]), 0.0, &Plates::default());
        assert_eq!(picture.rgba[..4], [0; 4]);
        let middle = 4 * (8 * 4 + 4);
        assert_eq!(picture.rgba[middle..middle + 4], [255; 4]);
    }
}
