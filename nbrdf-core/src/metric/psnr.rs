//! `mae`, `rmse`, `psnr`: pixel by pixel on displayed values, covered pixels only.

use crate::{Image, Rgb};

/// PSNR \[dB\] of identical images, and the most any pair gets.
pub const PSNR_CAP: f64 = 100.0;

/// Mean absolute difference of two *displayed* images over covered pixels and channels, 0..1.
///
/// # Panics
/// If the images or the mask differ in size (a bug of the caller); so do [`rmse`] and [`psnr`].
pub fn mae(reference: &Image, other: &Image, covered: &[bool]) -> f64 {
    mean_over(reference, other, covered, f64::abs)
}

/// Root of the mean squared difference of two *displayed* images over covered pixels and channels, 0..1.
pub fn rmse(reference: &Image, other: &Image, covered: &[bool]) -> f64 {
    mean_over(reference, other, covered, |difference| difference * difference).sqrt()
}

/// Peak signal-to-noise ratio \[dB\] of two *displayed* images, −20 log₁₀ rmse, at most [`PSNR_CAP`].
pub fn psnr(reference: &Image, other: &Image, covered: &[bool]) -> f64 {
    psnr_from_rmse(rmse(reference, other, covered))
}

pub(super) fn psnr_from_rmse(rmse: f64) -> f64 {
    (-20.0 * rmse.log10()).min(PSNR_CAP)
}

fn mean_over(reference: &Image, other: &Image, covered: &[bool], cost: impl Fn(f64) -> f64) -> f64 {
    assert_same_size(reference, other, covered);
    let (mut sum, mut count) = (0.0, 0_usize);
    for ((Rgb(f), Rgb(g)), _) in reference.pixels().iter().zip(other.pixels()).zip(covered).filter(|&(_, &on)| on) {
        for channel in 0..3 {
            sum += cost(f64::from(f[channel]) - f64::from(g[channel]));
        }
        count += 3;
    }
    sum / count.max(1) as f64
}

pub(super) fn assert_same_size(reference: &Image, other: &Image, covered: &[bool]) {
    assert_eq!((reference.width(), reference.height()), (other.width(), other.height()), "images of one size");
    assert_eq!(reference.pixels().len(), covered.len(), "one mask entry per pixel");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_covered_pixels_count() {
        let black = Image::black(2, 1);
        let other = Image::new(2, 1, vec![Rgb::splat(0.1), Rgb::splat(0.9)]);
        let covered = [true, false];
        assert!((mae(&black, &other, &covered) - 0.1).abs() < 1e-7);
        assert!((rmse(&black, &other, &covered) - 0.1).abs() < 1e-7);
        assert!((psnr(&black, &other, &covered) - 20.0).abs() < 1e-5);
    }

    #[test]
    fn identical_images_have_one_hundred_decibels() {
        let image = Image::new(1, 1, vec![Rgb::splat(0.3)]);
        assert_eq!(psnr(&image, &image, &[true]), PSNR_CAP);
    }
}
