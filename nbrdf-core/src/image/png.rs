//! PNG: what the display shows, 8 bits per channel.

use std::{io::Cursor, path::Path};

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use rayon::prelude::*;

use super::{DISPLAY_GAMMA, Image, ImageError, Tone, clipped};
use crate::simd::powers;
use crate::{Rgb, atomic};

/// Values that one task displays.
const PIECE: usize = 3 * 1024;

impl Image {
    /// The displayed image as a PNG file in memory.
    ///
    /// # Errors
    /// [`ImageError::Encode`] for an image without pixels or too large for the format; its path is empty.
    pub fn png_bytes(&self) -> Result<Vec<u8>, ImageError> {
        let refused = |reason: String| ImageError::Encode { path: "".into(), format: "PNG", reason };
        let side = |pixels: usize| u32::try_from(pixels).map_err(|error| refused(error.to_string()));
        let (width, height) = (side(self.width)?, side(self.height)?);
        if width == 0 || height == 0 {
            return Err(refused(format!("it is {width} x {height} pixels, expected at least 1 x 1")));
        }
        let mut bytes = Cursor::new(Vec::new());
        PngEncoder::new(&mut bytes)
            .write_image(&self.display_bytes(), width, height, ExtendedColorType::Rgb8)
            .map_err(|error| refused(error.to_string()))?;
        Ok(bytes.into_inner())
    }

    /// Displayed values as bytes: red, green, blue of each pixel, row by row from the top left.
    pub fn display_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.display_bytes_into(1.0, &mut bytes);
        bytes
    }

    /// As [`display_bytes`](Self::display_bytes) of the image times `gain`, over earlier bytes; allocates nothing where
    /// there is room.
    pub fn display_bytes_into(&self, gain: f32, bytes: &mut Vec<u8>) {
        self.bytes_into(|linear| clipped(linear * gain), bytes);
    }

    /// The same through another tone curve.
    pub fn toned_bytes_into(&self, gain: f32, tone: Tone, bytes: &mut Vec<u8>) {
        match tone {
            Tone::Clip => self.display_bytes_into(gain, bytes),
            _ => self.bytes_into(|linear| tone.shown(linear * gain), bytes),
        }
    }

    fn bytes_into(&self, shows: impl Fn(f32) -> f32 + Sync, bytes: &mut Vec<u8>) {
        let linear = Rgb::flat(&self.pixels);
        bytes.resize(linear.len(), 0);
        bytes.par_chunks_mut(PIECE).zip(linear.par_chunks(PIECE)).for_each(|(bytes, linear)| {
            let mut shown = [0.0; PIECE];
            let shown = &mut shown[..linear.len()];
            shown.iter_mut().zip(linear).for_each(|(shown, linear)| *shown = shows(*linear));
            powers(shown, 1.0 / DISPLAY_GAMMA);
            bytes.iter_mut().zip(shown).for_each(|(byte, v)| *byte = (*v * 255.0).round() as u8);
        });
    }

    /// Writes the displayed image as PNG; the file is whole or not there.
    ///
    /// # Errors
    /// [`ImageError`], which names the file.
    pub fn write_png(&self, path: &Path) -> Result<(), ImageError> {
        let bytes = self.png_bytes().map_err(|error| error.about(path))?;
        atomic::write(path, &bytes).map_err(|source| ImageError::Io { path: path.into(), source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;

    #[test]
    fn a_png_shows_the_displayed_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let image = Image::new(2, 1, vec![Rgb([0.0, 0.5, 2.0]), Rgb([1.0, 0.1, 0.01])]);
        image.write_png(&path).unwrap();
        let read = image::load_from_memory(&std::fs::read(&path).unwrap()).unwrap().into_rgb8();
        assert_eq!(read.dimensions(), (2, 1));
        assert_eq!(read.into_raw(), [0, 186, 255, 255, 90, 31]);
    }

    #[test]
    fn errors_name_the_file() {
        let error = Image::black(0, 3).write_png(Path::new("empty.png")).unwrap_err();
        assert!(error.to_string().starts_with("empty.png"), "{error}");
        let error = Image::black(1, 1).write_png(Path::new("no-such-folder/a.png")).unwrap_err();
        assert!(error.to_string().contains("no-such-folder"), "{error}");
    }
}
