//! OpenEXR: the linear values, 32-bit float.

use std::{io::Cursor, path::Path};

use exr::prelude::{Encoding, Image as ExrImage, LayerAttributes, SpecificChannels, Vec2, WritableImage};

use super::{Image, ImageError};
use crate::atomic;

impl Image {
    /// Writes the linear values as OpenEXR (channels R, G, B); the file is whole or not there.
    ///
    /// # Errors
    /// [`ImageError`], which names the file.
    pub fn write_exr(&self, path: &Path) -> Result<(), ImageError> {
        let refused = |reason: String| ImageError::Encode { path: path.into(), format: "OpenEXR", reason };
        if self.pixels.is_empty() {
            return Err(refused("it has no pixels".into()));
        }
        let pixel = |at: Vec2<usize>| {
            let [red, green, blue] = self.get(at.x(), at.y()).0;
            (red, green, blue)
        };
        let channels = SpecificChannels::rgb(pixel);
        let layer = exr::prelude::Layer::new(
            (self.width, self.height),
            LayerAttributes::default(),
            Encoding::FAST_LOSSLESS,
            channels,
        );
        let mut bytes = Cursor::new(Vec::new());
        ExrImage::from_layer(layer).write().to_buffered(&mut bytes).map_err(|error| refused(error.to_string()))?;
        atomic::write(path, &bytes.into_inner()).map_err(|source| ImageError::Io { path: path.into(), source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;

    #[test]
    fn an_exr_keeps_linear_values_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let image = Image::new(2, 1, vec![Rgb([0.1, -0.5, 1e4]), Rgb([1e-6, 3.0, 0.7])]);
        image.write_exr(&path).unwrap();
        let read = exr::prelude::read_first_rgba_layer_from_file(
            &path,
            |size, _| Image::black(size.width(), size.height()),
            |image: &mut Image, at, (r, g, b, _): (f32, f32, f32, f32)| {
                let width = image.width();
                image.pixels_mut()[at.y() * width + at.x()] = Rgb([r, g, b]);
            },
        );
        assert_eq!(read.unwrap().layer_data.channel_data.pixels, image);
    }

    #[test]
    fn an_empty_image_is_refused_by_name() {
        let error = Image::black(0, 0).write_exr(Path::new("empty.exr")).unwrap_err();
        assert!(error.to_string().starts_with("empty.exr"), "{error}");
    }
}
