//! Radiance pictures (`.hdr`, `.pic`): 8-bit mantissas with a shared exponent, run-length coded.
//!
//! G. Ward, *Real Pixels*, Graphics Gems II (1991), section II.5.

use std::io::{ErrorKind, Read};

use image::{DynamicImage, ImageDecoder, ImageError, codecs::hdr::HdrDecoder};

use super::{Image, read::ImageReadProblem, read::check_claim, read::check_size};
use crate::Rgb;

/// What files start with; the second is written by programs that follow B. Walter's published reader.
pub(super) const SIGNATURES: [&[u8]; 2] = [b"#?RADIANCE", b"#?RGBE"];

/// Most pixels that a byte can stand for: a row of 8192 of one colour takes 8 bytes in the older coding of runs.
const MOST_PER_BYTE: u64 = 1024;

/// The picture in a file; radiance is what the header's exposure and colour correction have been applied to.
///
/// # Errors
/// [`ImageReadProblem`]: beyond the size limits, cut off, damaged, or not in red, green and blue from the top left.
pub(super) fn read(from: impl Read, bytes: u64) -> Result<Image, ImageReadProblem> {
    // Not strict: a strict decoder refuses the second signature and unknown header lines.
    let decoder = HdrDecoder::new_nonstrict(from).map_err(problem)?;
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    check_size(width, height)?;
    check_claim(width, height, bytes, MOST_PER_BYTE)?;
    let header = decoder.metadata();
    let exposure = header.exposure.unwrap_or(1.0);
    let (red, green, blue) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let applied = Rgb([red, green, blue]) * exposure;
    let stored = DynamicImage::from_decoder(decoder).map_err(problem)?.into_rgb32f().into_raw();
    let (pixels, _) = stored.as_chunks::<3>();
    let pixels = pixels.iter().map(|&pixel| Rgb(pixel).zip(applied, |stored, applied| stored / applied)).collect();
    Ok(Image::new(width, height, pixels))
}

fn problem(error: ImageError) -> ImageReadProblem {
    match error {
        ImageError::IoError(error) if error.kind() != ErrorKind::UnexpectedEof => error.into(),
        ImageError::Unsupported(error) => {
            ImageReadProblem::Unsupported { format: "Radiance", reason: error.to_string() }
        }
        other => ImageReadProblem::Damaged { format: "Radiance", reason: other.to_string() },
    }
}
