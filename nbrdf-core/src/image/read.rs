//! Reading pictures with a high dynamic range: Radiance and OpenEXR, told apart by their first bytes.

use std::{
    fs::File,
    io::{self, BufRead, BufReader, Cursor, Seek},
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use super::{Image, exr, hdr};

/// Most pixels per row that are read.
pub const MAX_WIDTH: usize = 8192;
/// Most rows that are read.
pub const MAX_HEIGHT: usize = 4096;
/// Largest file that is read \[bytes\]: room for the largest picture as four uncompressed 32-bit channels.
pub const MAX_FILE: u64 = 640 << 20;

/// A file that is no readable picture: which one, and why.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {problem}")]
pub struct ImageReadError {
    /// The file asked for.
    pub file: String,
    /// What is wrong with it.
    pub problem: ImageReadProblem,
}

/// What is wrong with a picture: what was expected, what was found, what to do.
#[derive(Debug, thiserror::Error)]
pub enum ImageReadProblem {
    /// The file system says no.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// More bytes than the largest picture needs.
    #[error("expected at most {MAX_FILE} bytes, found {bytes}: scale the picture down")]
    FileTooLarge {
        /// Length of the file.
        bytes: u64,
    },
    /// The first bytes are those of neither format.
    #[error("expected a Radiance (.hdr) or OpenEXR (.exr) picture, found other bytes: convert it to one of these")]
    UnknownForm,
    /// A picture of another size than is read here.
    #[error(
        "expected 1 x 1 to {MAX_WIDTH} x {MAX_HEIGHT} pixels, found {width} x {height}: scale it, or export it again"
    )]
    Size {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A size that the file is too short for.
    #[error(
        "expected {width} x {height} pixels, as the header says, found {bytes} bytes, which cannot hold them: fetch or export it again"
    )]
    Claim {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
        /// Length of the file.
        bytes: u64,
    },
    /// An OpenEXR file that holds other things than one picture in red, green and blue.
    #[error(
        "expected one layer with the channels R, G and B at full resolution and at most 64 channels, found {found}: export it again as such"
    )]
    Channels {
        /// Layers and channels in the file.
        found: String,
    },
    /// A kind of picture that exists, but is not read here.
    #[error(
        "expected a {format} picture in red, green and blue from the top left, at most {MAX_WIDTH} x {MAX_HEIGHT} pixels: \
         {reason}; convert it to that"
    )]
    Unsupported {
        /// Name of the format.
        format: &'static str,
        /// What the decoder said.
        reason: String,
    },
    /// The file stops, or contradicts itself.
    #[error(
        "expected a whole {format} file, found one that is cut off or damaged ({reason}): fetch or export it again"
    )]
    Damaged {
        /// Name of the format.
        format: &'static str,
        /// What the decoder said.
        reason: String,
    },
}

impl Image {
    /// Reads linear radiances from a Radiance or an OpenEXR picture; values are as the file has them, NaN included.
    ///
    /// # Errors
    /// [`ImageReadError`] naming the file: not there, of another form, beyond the size limits, cut off or damaged.
    pub fn read(path: &Path) -> Result<Self, ImageReadError> {
        let of = |problem: ImageReadProblem| ImageReadError { file: path.display().to_string(), problem };
        let read = || -> Result<Self, ImageReadProblem> {
            let file = File::open(path)?;
            let bytes = file.metadata()?.len();
            decode(BufReader::new(file), bytes)
        };
        read().map_err(of)
    }

    /// As [`read`](Self::read), from the bytes of a file.
    ///
    /// # Errors
    /// [`ImageReadProblem`].
    pub fn parse(bytes: &[u8]) -> Result<Self, ImageReadProblem> {
        decode(Cursor::new(bytes), bytes.len() as u64)
    }
}

/// The picture in a file of so many bytes.
fn decode(mut from: impl BufRead + Seek, bytes: u64) -> Result<Image, ImageReadProblem> {
    if bytes > MAX_FILE {
        return Err(ImageReadProblem::FileTooLarge { bytes });
    }
    let start = from.fill_buf()?;
    if start.starts_with(&exr::SIGNATURE) {
        guarded("OpenEXR", || exr::read(from, bytes))
    } else if hdr::SIGNATURES.iter().any(|signature| start.starts_with(signature)) {
        guarded("Radiance", || hdr::read(from, bytes))
    } else {
        Err(ImageReadProblem::UnknownForm)
    }
}

/// The decoders are other people's and meet any bytes here: where one panics, the file is at fault, not the program.
fn guarded(
    format: &'static str,
    read: impl FnOnce() -> Result<Image, ImageReadProblem>,
) -> Result<Image, ImageReadProblem> {
    catch_unwind(AssertUnwindSafe(read))
        .unwrap_or_else(|_| Err(ImageReadProblem::Damaged { format, reason: "the decoder gave up".into() }))
}

/// Refuses what would be empty or too large, to be asked before memory is.
pub(super) fn check_size(width: usize, height: usize) -> Result<(), ImageReadProblem> {
    let fits = (1..=MAX_WIDTH).contains(&width) && (1..=MAX_HEIGHT).contains(&height);
    if fits { Ok(()) } else { Err(ImageReadProblem::Size { width, height }) }
}

/// Refuses a size that so many bytes cannot hold at `most` pixels a byte: memory is asked for what a file can fill, not
/// for what its header claims.
pub(super) fn check_claim(width: usize, height: usize, bytes: u64, most: u64) -> Result<(), ImageReadProblem> {
    let pixels = width as u64 * height as u64;
    if pixels <= bytes.saturating_mul(most) { Ok(()) } else { Err(ImageReadProblem::Claim { width, height, bytes }) }
}

#[cfg(test)]
mod tests;
