//! `flip`: the difference a viewer sees when flipping between two images.
//!
//! P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, *FLIP: A Difference Evaluator
//! for Alternating Images* (2020), doi 10.1145/3406183: LDR-FLIP with the paper's constants at 67 pixels per degree.
//! Differs from the common tools only in arithmetic: floats from end to end (no 8-bit input), filters separated.

mod color;
mod feature;
mod spatial;

use self::{
    color::{Lab, hunt_lab_from_linear, hyab_hunt, linear_from_ycxcz, ycxcz_from_srgb},
    feature::Features,
};
use super::plane::Plane;
use crate::{Image, Rgb};

/// Pixels per degree of visual angle: 0.7 m from a 4K screen 0.7 m wide.
const PIXELS_PER_DEGREE: f64 = 67.0;
/// Exponent of colour differences (section 4.1.3).
const Q_COLOR: f64 = 0.7;
/// Exponent of feature differences (section 4.2).
const Q_FEATURE: f64 = 0.5;
/// Colour differences up to this share of the largest are stretched ...
const P_COLOR: f64 = 0.4;
/// ... over this share of the result.
const P_TARGET: f64 = 0.95;

/// Mean LDR-FLIP of two *displayed* images over all pixels, 0..1.
///
/// # Panics
/// If the images differ in size (a bug of the caller).
pub fn flip(reference: &Image, other: &Image) -> f64 {
    let map = flip_map(reference, other);
    map.iter().map(|&error| f64::from(error)).sum::<f64>() / map.len().max(1) as f64
}

/// LDR-FLIP of two *displayed* images pixel by pixel, row by row from the top left, each 0..1.
///
/// # Panics
/// If the images differ in size (a bug of the caller).
pub fn flip_map(reference: &Image, other: &Image) -> Vec<f32> {
    assert_eq!((reference.width(), reference.height()), (other.width(), other.height()), "images of one size");
    if reference.pixels().is_empty() {
        return Vec::new();
    }
    Seen::new(reference).flip_map(&Seen::new(other))
}

/// LDR-FLIP of two *displayed* colours on wide fields of them, 0..1: no filter, no edges.
pub fn flip_of_colors(reference: Rgb, other: Rgb) -> f64 {
    let lab = |color: Rgb| hunt_lab_from_linear(linear_from_ycxcz(ycxcz_from_srgb(color)));
    stretched(hyab_hunt(lab(reference), lab(other)).powf(Q_COLOR), largest_color_difference())
}

/// What is left of an image in the eye, filtered colours, edges and points: for images that are compared with many others.
pub struct Seen {
    color: Vec<Lab>,
    features: Features,
}

impl Seen {
    /// How far a pixel is from the farthest that it takes part in.
    pub const REACH: usize = 10;

    /// Of a *displayed* image of at least one pixel.
    pub fn new(displayed: &Image) -> Self {
        let opponent = Plane::from_pixels(displayed, ycxcz_from_srgb);
        Self { features: Features::new(&opponent[0]), color: spatial::filtered(&opponent) }
    }

    /// As [`flip_map`].
    ///
    /// # Panics
    /// If the images differ in size (a bug of the caller).
    pub fn flip_map(&self, other: &Self) -> Vec<f32> {
        assert_eq!(self.color.len(), other.color.len(), "images of one size");
        let largest = largest_color_difference();
        let error = |i: usize| {
            let color = stretched(hyab_hunt(self.color[i], other.color[i]).powf(Q_COLOR), largest);
            let feature = self.features.difference(&other.features, i).powf(Q_FEATURE);
            color.powf(1.0 - feature) as f32
        };
        (0..self.color.len()).map(error).collect()
    }
}

/// Between pure green and pure blue, after the exponent (section 4.1.3).
fn largest_color_difference() -> f64 {
    let (green, blue) = (hunt_lab_from_linear([0.0, 1.0, 0.0]), hunt_lab_from_linear([0.0, 0.0, 1.0]));
    hyab_hunt(green, blue).powf(Q_COLOR)
}

/// Gives small differences most of the range 0..1 (section 4.1.3, eq. 11).
fn stretched(difference: f64, largest: f64) -> f64 {
    let knee = P_COLOR * largest;
    if difference < knee {
        P_TARGET / knee * difference
    } else {
        P_TARGET + (difference - knee) / (largest - knee) * (1.0 - P_TARGET)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(value: Rgb) -> Image {
        Image::new(24, 20, vec![value; 480])
    }

    #[test]
    fn identical_images_do_not_flip() {
        let image = flat(Rgb([0.2, 0.5, 0.9]));
        assert_eq!(flip(&image, &image), 0.0);
    }

    #[test]
    fn pure_green_against_pure_blue_is_the_largest_difference() {
        let error = flip(&flat(Rgb([0.0, 1.0, 0.0])), &flat(Rgb([0.0, 0.0, 1.0])));
        assert!((error - 1.0).abs() < 1e-6, "{error}");
    }

    #[test]
    fn an_edge_makes_a_colour_difference_count_more() {
        let reference = flat(Rgb::splat(0.5));
        let mut other = reference.clone();
        other.pixels_mut().iter_mut().enumerate().filter(|(i, _)| i % 24 < 12).for_each(|(_, p)| *p = Rgb::splat(0.6));
        let map = flip_map(&reference, &other);
        assert!(map[10 * 24 + 11] > map[10 * 24] && map[10 * 24] > 0.0);
    }
}
