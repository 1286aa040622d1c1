//! Linear images: what a renderer makes, what a metric compares, what a file shows.

mod exr;
mod hdr;
mod png;
pub(crate) mod read;
mod tone;

use std::{
    io,
    path::{Path, PathBuf},
};

pub use tone::Tone;

use crate::Rgb;
use crate::simd::powers;

/// Exponent of the display: shown value = clip(linear, 0, 1)^(1/2.2).
pub const DISPLAY_GAMMA: f32 = 2.2;

/// `width` × `height` linear pixels (BT.709 primaries), row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
}

/// Why an image was not written.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The pixels do not fit the format.
    #[error("{path}: cannot be encoded as {format}: {reason}")]
    Encode {
        /// The file asked for.
        path: PathBuf,
        /// Name of the format.
        format: &'static str,
        /// What the encoder said.
        reason: String,
    },
    /// The file system refused.
    #[error("{path}")]
    Io {
        /// The file asked for.
        path: PathBuf,
        /// What the file system said.
        source: io::Error,
    },
}

impl ImageError {
    /// The same error about this file.
    fn about(self, path: &Path) -> Self {
        match self {
            Self::Encode { format, reason, .. } => Self::Encode { path: path.into(), format, reason },
            Self::Io { source, .. } => Self::Io { path: path.into(), source },
        }
    }
}

impl Image {
    /// From pixels row by row, top row first.
    ///
    /// # Panics
    /// If there are not `width * height` pixels (a bug of the caller).
    pub fn new(width: usize, height: usize, pixels: Vec<Rgb>) -> Self {
        assert_eq!(pixels.len(), width * height, "one value per pixel");
        Self { width, height, pixels }
    }

    /// All black.
    pub fn black(width: usize, height: usize) -> Self {
        Self::new(width, height, vec![Rgb::BLACK; width * height])
    }

    /// Pixels per row.
    pub const fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub const fn height(&self) -> usize {
        self.height
    }

    /// All pixels, row by row from the top left.
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// All pixels, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [Rgb] {
        &mut self.pixels
    }

    /// The pixel in column `x` (from the left) and row `y` (from the top).
    ///
    /// # Panics
    /// If the pixel is outside (a bug of the caller).
    pub fn get(&self, x: usize, y: usize) -> Rgb {
        assert!(x < self.width && y < self.height, "({x}, {y}) is outside {} x {}", self.width, self.height);
        self.pixels[y * self.width + x]
    }

    /// Every pixel through `f`.
    pub fn map(&self, f: impl FnMut(Rgb) -> Rgb) -> Self {
        Self { pixels: self.pixels.iter().copied().map(f).collect(), ..*self }
    }

    /// What a display shows: clip(L, 0, 1)^(1/2.2), 0..1. NaN shows black.
    pub fn displayed(&self) -> Self {
        let mut shown = Self::default();
        self.displayed_into(1.0, &mut shown);
        shown
    }

    /// As [`displayed`](Self::displayed) of the image times `gain`, over an earlier picture; allocates nothing where
    /// there is room.
    pub fn displayed_into(&self, gain: f32, shown: &mut Self) {
        (shown.width, shown.height) = (self.width, self.height);
        shown.pixels.clear();
        shown.pixels.extend(self.pixels.iter().map(|pixel| pixel.map(|linear| clipped(gain * linear))));
        powers(Rgb::flat_mut(&mut shown.pixels), 1.0 / DISPLAY_GAMMA);
    }

    /// The images side by side, tops aligned, `gap` black columns between them.
    pub fn beside(images: &[Self], gap: usize) -> Self {
        let width = joined(images.iter().map(|image| image.width), gap);
        let height = images.iter().map(|image| image.height).max().unwrap_or(0);
        let mut strip = Self::black(width, height);
        let mut left = 0;
        for image in images {
            strip.paste(image, left, 0);
            left += image.width + gap;
        }
        strip
    }

    /// The images one below the other, left sides aligned, `gap` black rows between them.
    pub fn stacked(images: &[Self], gap: usize) -> Self {
        let width = images.iter().map(|image| image.width).max().unwrap_or(0);
        let height = joined(images.iter().map(|image| image.height), gap);
        let mut column = Self::black(width, height);
        let mut top = 0;
        for image in images {
            column.paste(image, 0, top);
            top += image.height + gap;
        }
        column
    }

    /// Puts `image` over this one, its top left pixel in column `left` and row `top`.
    ///
    /// # Panics
    /// If it does not fit (a bug of the caller).
    pub fn paste(&mut self, image: &Self, left: usize, top: usize) {
        for y in 0..image.height {
            let start = (top + y) * self.width + left;
            let row = &image.pixels[y * image.width..(y + 1) * image.width];
            self.pixels[start..start + image.width].copy_from_slice(row);
        }
    }
}

/// Clipped to 0..1; NaN, which `clamp` would keep, becomes 0.
pub(crate) fn clipped(linear: f32) -> f32 {
    if linear > 0.0 { linear.min(1.0) } else { 0.0 }
}

fn joined(sizes: impl ExactSizeIterator<Item = usize>, gap: usize) -> usize {
    gap * sizes.len().saturating_sub(1) + sizes.sum::<usize>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn display_clips_and_half_shows_as_0_73() {
        let image = Image::new(2, 2, vec![Rgb::splat(-1.0), Rgb::splat(0.5), Rgb::splat(7.0), Rgb::splat(f32::NAN)]);
        let shown = image.displayed();
        assert_eq!(shown.get(0, 0), Rgb::BLACK);
        assert!((shown.get(1, 0)[1] - 0.729_740).abs() < 1e-5);
        assert_eq!(shown.get(0, 1), Rgb::splat(1.0));
        assert_eq!(shown.get(1, 1), Rgb::BLACK);
    }

    #[test]
    fn strips_keep_every_image_and_a_gap() {
        let (white, grey) = (Rgb::splat(1.0), Rgb::splat(0.5));
        let parts = [Image::new(1, 1, vec![white]), Image::new(1, 2, vec![grey; 2])];
        let strip = Image::beside(&parts, 1);
        assert_eq!((strip.width(), strip.height()), (3, 2));
        assert_eq!(strip.pixels(), [white, Rgb::BLACK, grey, Rgb::BLACK, Rgb::BLACK, grey]);
        let column = Image::stacked(&parts, 1);
        assert_eq!((column.width(), column.height()), (1, 4));
        assert_eq!(column.pixels(), [white, Rgb::BLACK, grey, grey]);
    }
}
