//! Maps that are none.

use crate::{Image, image::read::ImageReadError};

/// Why a file is no environment; the message names the file.
#[derive(Debug, thiserror::Error)]
pub enum EnvironmentError {
    /// It is no picture that can be read.
    #[error(transparent)]
    Read(#[from] ImageReadError),
    /// The picture is no map of radiances.
    #[error("{file}: {problem}")]
    Map {
        /// The file asked for.
        file: String,
        /// What is wrong with the picture.
        problem: EnvironmentProblem,
    },
}

/// What is wrong with a map: what was expected, what was found, what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EnvironmentProblem {
    /// Not twice as wide as high.
    #[error(
        "expected a latitude-longitude map, twice as wide as high, found {width} x {height} pixels: \
         convert it to that projection, or crop it"
    )]
    Shape {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// A pixel that is no radiance.
    #[error(
        "expected radiances, finite and not negative, found {value} in the {channel} of column {x}, row {y} \
         (from 0, at the top left): repair or clip that pixel"
    )]
    Radiance {
        /// The number there.
        value: f32,
        /// Name of its channel.
        channel: &'static str,
        /// Pixels to its left.
        x: usize,
        /// Rows above it.
        y: usize,
    },
}

/// Refuses other shapes and the first pixel that is no radiance.
pub(super) fn check(map: &Image) -> Result<(), EnvironmentProblem> {
    let (width, height) = (map.width(), map.height());
    if height == 0 || width != 2 * height {
        return Err(EnvironmentProblem::Shape { width, height });
    }
    for (index, pixel) in map.pixels().iter().enumerate() {
        for (value, channel) in pixel.0.into_iter().zip(["red", "green", "blue"]) {
            if !(value.is_finite() && value >= 0.0) {
                return Err(EnvironmentProblem::Radiance { value, channel, x: index % width, y: index / width });
            }
        }
    }
    Ok(())
}
