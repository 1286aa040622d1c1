//! The difference of two pictures as a heat map.

use nbrdf_core::Image;
use nbrdf_core::metric::flip_map;

use crate::report::heat::heat;

/// Errors of this many times the tolerance are white.
pub const WHITE: f64 = 4.0;

/// FLIP of two linear pictures pixel by pixel, from black at 0 to white at `white`.
///
/// # Panics
/// If the pictures differ in size (a bug of the caller).
pub fn difference(reference: &Image, other: &Image, white: f64) -> Image {
    let map = flip_map(&reference.displayed(), &other.displayed());
    let heat = map.iter().map(|&error| heat(f64::from(error) / white)).collect();
    Image::new(reference.width(), reference.height(), heat)
}
