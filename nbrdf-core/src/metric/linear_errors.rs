//! How far the light of two pictures differs: on linear values, where sums mean energy.

use super::psnr::assert_same_size;
use crate::{Image, Rgb};

/// Channels darker than this share of the brightest are judged as if they were so bright.
const DARK: f64 = 0.01;

/// Relative differences of two *linear* pictures, each of the worst channel, 0 for equal ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearErrors {
    /// |Σ other − Σ reference| / Σ reference: of the mean over the picture.
    pub of_mean: f64,
    /// Σ |other − reference| / Σ reference: of the pixels.
    pub of_pixels: f64,
}

impl LinearErrors {
    /// Over covered pixels. A channel that has less than a hundredth of the light of the brightest is judged by a hundredth
    /// of that one. Pictures that hold NaN are infinitely far.
    ///
    /// # Panics
    /// If the pictures or the mask differ in size (a bug of the caller).
    pub fn of(reference: &Image, other: &Image, covered: &[bool]) -> Self {
        assert_same_size(reference, other, covered);
        let pixels = reference.pixels().iter().zip(other.pixels()).zip(covered).filter(|&(_, &is_covered)| is_covered);
        // Of each channel: the reference's light, what is more or less, and what is elsewhere.
        let mut sums = [[0.0_f64; 3]; 3];
        for ((Rgb(reference), Rgb(other)), _) in pixels {
            for (([light, change, distance], from), to) in sums.iter_mut().zip(reference).zip(other) {
                let [from, to] = [*from, *to].map(f64::from);
                *light += from;
                *change += to - from;
                *distance += (to - from).abs();
            }
        }
        let least = (DARK * sums.iter().map(|[light, ..]| *light).fold(0.0, f64::max)).max(f64::MIN_POSITIVE);
        // A maximum passes over NaN.
        let told = |error: f64| if error.is_nan() { f64::INFINITY } else { error };
        let worst =
            |which: usize| sums.iter().map(|sum| told(sum[which].abs() / sum[0].max(least))).fold(0.0, f64::max);
        Self { of_mean: worst(1), of_pixels: worst(2) }
    }

    /// The larger of each.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self { of_mean: self.of_mean.max(other.of_mean), of_pixels: self.of_pixels.max(other.of_pixels) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_moved_changes_pixels_and_what_is_added_changes_the_mean() {
        let picture = |left: f32, right: f32| Image::new(2, 1, vec![Rgb([left, 1.0, 0.0]), Rgb([right, 1.0, 0.0])]);
        let covered = [true, true];
        let moved = LinearErrors::of(&picture(1.0, 3.0), &picture(3.0, 1.0), &covered);
        assert_eq!((moved.of_mean, moved.of_pixels), (0.0, 1.0));
        let added = LinearErrors::of(&picture(1.0, 3.0), &picture(1.0, 4.0), &covered);
        assert_eq!((added.of_mean, added.of_pixels), (0.25, 0.25));
        let spoilt = LinearErrors::of(&picture(1.0, 3.0), &picture(1.0, f32::NAN), &covered);
        assert_eq!((spoilt.of_mean, spoilt.of_pixels), (f64::INFINITY, f64::INFINITY));
        assert_eq!(LinearErrors::of(&picture(1.0, 3.0), &picture(1.0, 4.0), &[true, false]), LinearErrors::default());
    }

    #[test]
    fn next_to_nothing_in_a_dark_channel_is_no_large_error() {
        let [black, other] = [0.0, 0.001].map(|blue| Image::new(1, 1, vec![Rgb([1.0, 0.5, blue])]));
        assert!((LinearErrors::of(&black, &other, &[true]).of_mean - 0.1).abs() < 1e-6);
    }
}
