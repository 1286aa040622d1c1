//! OpenEXR: the linear values, 32-bit float.

use std::{
    io::{Cursor, Read, Seek},
    path::Path,
};

use exr::{
    block::reader::Reader,
    error::Error,
    meta::{BlockDescription, header::Header, magic_number},
    prelude::{
        Encoding, Image as ExrImage, LayerAttributes, ReadChannels, ReadLayers, SpecificChannels, Vec2, WritableImage,
    },
};

use super::{Image, ImageError, read::ImageReadProblem, read::check_claim, read::check_size};
use crate::{Rgb, atomic};

/// Channels read at most; renderers' files hold a few dozen.
const MAX_CHANNELS: usize = 64;
/// Most pixels that a byte can stand for: deflate makes 1032 of one, and a pixel has three halves.
const MOST_PER_BYTE: u64 = 256;
/// Pixels along a tile that any picture may have, also one that is smaller.
const TILE: usize = 1024;
/// Channels named in an error.
const NAMED: usize = 8;
/// What files start with.
pub(super) const SIGNATURE: [u8; 4] = magic_number::BYTES;

impl Image {
    /// The linear values as an OpenEXR file in memory (channels R, G, B).
    ///
    /// # Errors
    /// [`ImageError::Encode`] for an image without pixels or too large for the format; its path is empty.
    pub fn exr_bytes(&self) -> Result<Vec<u8>, ImageError> {
        let refused = |reason: String| ImageError::Encode { path: "".into(), format: "OpenEXR", reason };
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
        Ok(bytes.into_inner())
    }

    /// Writes the linear values as OpenEXR (channels R, G, B); the file is whole or not there.
    ///
    /// # Errors
    /// [`ImageError`], which names the file.
    pub fn write_exr(&self, path: &Path) -> Result<(), ImageError> {
        let bytes = self.exr_bytes().map_err(|error| error.about(path))?;
        atomic::write(path, &bytes).map_err(|source| ImageError::Io { path: path.into(), source })
    }
}

/// The picture in a file of one layer; alpha and other channels are left aside.
///
/// # Errors
/// [`ImageReadProblem`]: beyond the size limits, other layers or channels, cut off or damaged.
pub(super) fn read(from: impl Read + Seek, bytes: u64) -> Result<Image, ImageReadProblem> {
    let chunks = Reader::read_from_buffered(from, false).map_err(problem)?;
    check_channels(chunks.headers())?;
    let Vec2(width, height) = chunks.headers()[0].layer_size;
    check_size(width, height)?;
    check_claim(width, height, bytes, MOST_PER_BYTE)?;
    check_tiles(&chunks.headers()[0])?;
    // A damaged table of blocks may leave pixels out; they are not to pass for black.
    let create = move |_, _: &_| Image::new(width, height, vec![Rgb::splat(f32::NAN); width * height]);
    let set = move |image: &mut Image, at: Vec2<usize>, (red, green, blue): (f32, f32, f32)| {
        if at.x() < width && at.y() < height {
            image.pixels[at.y() * width + at.x()] = Rgb([red, green, blue]);
        }
    };
    let reader = exr::prelude::read().no_deep_data().largest_resolution_level().rgb_channels(create, set);
    let read = reader.first_valid_layer().all_attributes().non_parallel().from_chunks(chunks);
    Ok(read.map_err(problem)?.layer_data.channel_data.pixels)
}

/// Refuses layers without R, G, B of full size, and more channels than any picture of ours has a use for: the decoder
/// takes memory for all of them.
fn check_channels(layers: &[Header]) -> Result<(), ImageReadProblem> {
    let full = |layer: &Header, name: &str| {
        layer.channels.list.iter().any(|channel| channel.name.eq(name) && channel.sampling == Vec2(1, 1))
    };
    if let [layer] = layers
        && layer.channels.list.len() <= MAX_CHANNELS
        && ["R", "G", "B"].iter().all(|name| full(layer, name))
    {
        return Ok(());
    }
    let channels = layers.iter().flat_map(|layer| &layer.channels.list).map(|channel| channel.name.to_string());
    let mut names: Vec<String> = channels.take(NAMED + 1).collect();
    if names.len() > NAMED {
        let all: usize = layers.iter().map(|layer| layer.channels.list.len()).sum();
        names[NAMED] = format!("... ({all} channels)");
    }
    let layers = if let [_] = layers { "1 layer".to_owned() } else { format!("{} layers", layers.len()) };
    Err(ImageReadProblem::Channels { found: format!("{layers} with {}", names.join(", ")) })
}

/// Refuses tiles that reach far beyond the picture: the decoder takes memory for all of their pixels.
fn check_tiles(layer: &Header) -> Result<(), ImageReadProblem> {
    let BlockDescription::Tiles(tiles) = layer.blocks else { return Ok(()) };
    let (Vec2(width, height), Vec2(across, down)) = (layer.layer_size, tiles.tile_size);
    if across <= width.max(TILE) && down <= height.max(TILE) {
        return Ok(());
    }
    let reason = format!("tiles of {across} × {down} pixels in a picture of {width} × {height}");
    Err(ImageReadProblem::Damaged { format: "OpenEXR", reason })
}

fn problem(error: Error) -> ImageReadProblem {
    match error {
        Error::Io(error) => error.into(),
        other => ImageReadProblem::Damaged { format: "OpenEXR", reason: other.to_string() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
