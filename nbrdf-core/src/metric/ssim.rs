//! `ssim`: structural similarity.
//!
//! Z. Wang, A. Bovik, H. Sheikh, E. Simoncelli, *Image Quality Assessment: From Error Visibility to Structural
//! Similarity* (2004), eq. 13 with K = 0.01, 0.03: Gaussian window 11 × 11, σ 1.5, population covariance. Each
//! channel by itself, then the mean; a border of 5 pixels, where the window sticks out, is left out.

use super::plane::{Plane, gaussian, normalised};
use crate::Image;

/// Half the window, and the border left out.
const RADIUS: usize = 5;
const SIGMA: f64 = 1.5;
/// (K₁ L)² and (K₂ L)² for values of range L = 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// Mean structural similarity of two *displayed* images, −1..1, 1 for identical ones.
///
/// Images no larger than the border twice have no pixel to average and count as identical.
///
/// # Panics
/// If the images differ in size (a bug of the caller).
pub fn ssim(reference: &Image, other: &Image) -> f64 {
    assert_eq!((reference.width(), reference.height()), (other.width(), other.height()), "images of one size");
    if reference.width() <= 2 * RADIUS || reference.height() <= 2 * RADIUS {
        return 1.0;
    }
    let window = normalised(gaussian(RADIUS, SIGMA));
    (0..3).map(|channel| channel_ssim(reference, other, channel, &window)).sum::<f64>() / 3.0
}

fn channel_ssim(reference: &Image, other: &Image, channel: usize, window: &[f64]) -> f64 {
    let (x, y) = (Plane::from_channel(reference, channel), Plane::from_channel(other, channel));
    let mean_x = x.blurred(window);
    let mean_y = y.blurred(window);
    // The variances only enter as a sum, so one blur serves both.
    let squares = x.zip(&y, |x, y| x * x + y * y).blurred(window);
    let products = x.zip(&y, |x, y| x * y).blurred(window);
    let mut sum = 0.0;
    for row in RADIUS..x.height - RADIUS {
        for i in row * x.width + RADIUS..(row + 1) * x.width - RADIUS {
            let (mx, my) = (mean_x.values[i], mean_y.values[i]);
            let variances = squares.values[i] - mx * mx - my * my;
            let covariance = products.values[i] - mx * my;
            sum += (2.0 * mx * my + C1) * (2.0 * covariance + C2) / ((mx * mx + my * my + C1) * (variances + C2));
        }
    }
    sum / ((x.width - 2 * RADIUS) * (x.height - 2 * RADIUS)) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;

    fn checker(width: usize, height: usize, contrast: f32) -> Image {
        let pixel =
            |i: usize| Rgb::splat(0.5 + if (i % width + i / width).is_multiple_of(2) { contrast } else { -contrast });
        Image::new(width, height, (0..width * height).map(pixel).collect())
    }

    #[test]
    fn identical_images_have_similarity_one() {
        let image = checker(20, 16, 0.3);
        assert!((ssim(&image, &image) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn inverted_structure_is_negative() {
        assert!(ssim(&checker(20, 16, 0.3), &checker(20, 16, -0.3)) < -0.9);
    }

    #[test]
    fn flat_images_compare_by_their_means() {
        let flat = |v: f32| Image::new(12, 12, vec![Rgb::splat(v); 144]);
        let (a, b) = (0.25, 0.75);
        let expected = (2.0 * a * b + C1) / (a * a + b * b + C1);
        assert!((ssim(&flat(0.25), &flat(0.75)) - expected).abs() < 1e-12);
    }
}
