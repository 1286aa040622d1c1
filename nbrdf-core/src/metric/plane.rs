//! One channel of an image in f64, and separable filters over it.

use crate::{Image, Rgb};

/// `width` × `height` values, row by row from the top left.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f64>,
}

impl Plane {
    pub(super) fn from_channel(image: &Image, channel: usize) -> Self {
        let values = image.pixels().iter().map(|pixel| f64::from(pixel[channel])).collect();
        Self { width: image.width(), height: image.height(), values }
    }

    /// The three planes of what `convert` makes of each pixel.
    pub(super) fn from_pixels(image: &Image, convert: impl Fn(Rgb) -> [f64; 3]) -> [Self; 3] {
        let converted: Vec<[f64; 3]> = image.pixels().iter().map(|&pixel| convert(pixel)).collect();
        std::array::from_fn(|channel| Self {
            width: image.width(),
            height: image.height(),
            values: converted.iter().map(|value| value[channel]).collect(),
        })
    }

    /// Value by value.
    pub(super) fn zip(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let values = self.values.iter().zip(&other.values).map(|(&a, &b)| f(a, b)).collect();
        Self { values, ..*self }
    }

    /// Correlated with an odd kernel along rows; pixels beyond the border repeat the border's.
    pub(super) fn along_rows(&self, kernel: &[f64]) -> Self {
        let radius = kernel.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        let mut padded = vec![0.0; self.width + 2 * radius];
        for (row, out) in self.values.chunks_exact(self.width).zip(values.chunks_exact_mut(self.width)) {
            padded[..radius].fill(row[0]);
            padded[radius..radius + self.width].copy_from_slice(row);
            padded[radius + self.width..].fill(row[self.width - 1]);
            for (shift, &weight) in kernel.iter().enumerate() {
                add_scaled(out, weight, &padded[shift..shift + self.width]);
            }
        }
        Self { values, ..*self }
    }

    /// Correlated with an odd kernel along columns; pixels beyond the border repeat the border's.
    pub(super) fn along_columns(&self, kernel: &[f64]) -> Self {
        let radius = kernel.len() / 2;
        let mut values = vec![0.0; self.values.len()];
        for (y, out) in values.chunks_exact_mut(self.width).enumerate() {
            for (shift, &weight) in kernel.iter().enumerate() {
                let from = (y + shift).saturating_sub(radius).min(self.height - 1);
                add_scaled(out, weight, &self.values[from * self.width..(from + 1) * self.width]);
            }
        }
        Self { values, ..*self }
    }

    /// Correlated with the same odd kernel along rows and columns.
    pub(super) fn blurred(&self, kernel: &[f64]) -> Self {
        self.along_rows(kernel).along_columns(kernel)
    }
}

fn add_scaled(out: &mut [f64], weight: f64, values: &[f64]) {
    for (out, value) in out.iter_mut().zip(values) {
        *out += weight * value;
    }
}

/// exp(−x² / (2σ²)) for x = −radius..radius, not normalised.
pub(super) fn gaussian(radius: usize, sigma: f64) -> Vec<f64> {
    let radius = radius as i32;
    (-radius..=radius).map(|x| (-f64::from(x * x) / (2.0 * sigma * sigma)).exp()).collect()
}

/// The kernel divided by its sum.
pub(super) fn normalised(kernel: Vec<f64>) -> Vec<f64> {
    let sum: f64 = kernel.iter().sum();
    kernel.into_iter().map(|weight| weight / sum).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Plane {
        Plane { width: 4, height: 3, values: (0..12).map(f64::from).collect() }
    }

    #[test]
    fn a_shifted_tap_moves_along_rows_and_repeats_the_border() {
        let moved = ramp().along_rows(&[0.0, 0.0, 1.0]);
        assert_eq!(moved.values[..4], [1.0, 2.0, 3.0, 3.0]);
    }

    #[test]
    fn a_shifted_tap_moves_along_columns_and_repeats_the_border() {
        let moved = ramp().along_columns(&[0.0, 0.0, 1.0]);
        assert_eq!(moved.values[..4], [4.0, 5.0, 6.0, 7.0]);
        assert_eq!(moved.values[8..], [8.0, 9.0, 10.0, 11.0]);
    }

    #[test]
    fn blurring_keeps_a_constant() {
        let flat = Plane { width: 5, height: 7, values: vec![0.25; 35] };
        let blurred = flat.blurred(&normalised(gaussian(10, 2.0)));
        assert!(blurred.values.iter().all(|v| (v - 0.25).abs() < 1e-15));
    }
}
