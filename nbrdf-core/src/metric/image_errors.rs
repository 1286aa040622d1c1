//! All image errors of one pair of pictures at once: pictures are rendered and displayed only once.

use serde::{Deserialize, Serialize};

use super::{
    delta_e_itp::delta_e_itp,
    flip::flip,
    psnr::{mae, psnr, psnr_from_rmse, rmse},
    ssim::ssim,
};
use crate::Image;

/// The image errors by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ImageMetric {
    /// Mean absolute error of displayed covered pixels.
    Mae,
    /// Root mean squared error of displayed covered pixels.
    Rmse,
    /// Peak signal-to-noise ratio \[dB\] of displayed covered pixels.
    Psnr,
    /// Structural similarity of the displayed image.
    Ssim,
    /// LDR-FLIP of the displayed image.
    Flip,
    /// Mean ΔE_ITP of covered pixels.
    DeltaEItp,
}

/// All image errors of one pair of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageErrors {
    /// See [`mae`].
    pub mae: f64,
    /// See [`rmse`].
    pub rmse: f64,
    /// See [`psnr`](super::psnr()).
    pub psnr: f64,
    /// See [`ssim`].
    pub ssim: f64,
    /// See [`flip`].
    pub flip: f64,
    /// See [`delta_e_itp`].
    pub delta_e_itp: f64,
}

/// All errors of two *linear* pictures; `covered` marks the pixels on the sphere.
///
/// # Panics
/// If the pictures or the mask differ in size (a bug of the caller).
pub fn image_errors(reference: &Image, other: &Image, covered: &[bool]) -> ImageErrors {
    let (shown_reference, shown_other) = (reference.displayed(), other.displayed());
    let rmse = rmse(&shown_reference, &shown_other, covered);
    ImageErrors {
        mae: mae(&shown_reference, &shown_other, covered),
        rmse,
        psnr: psnr_from_rmse(rmse),
        ssim: ssim(&shown_reference, &shown_other),
        flip: flip(&shown_reference, &shown_other),
        delta_e_itp: delta_e_itp(reference, other, covered),
    }
}

impl ImageErrors {
    /// The error of this name.
    pub const fn get(&self, metric: ImageMetric) -> f64 {
        match metric {
            ImageMetric::Mae => self.mae,
            ImageMetric::Rmse => self.rmse,
            ImageMetric::Psnr => self.psnr,
            ImageMetric::Ssim => self.ssim,
            ImageMetric::Flip => self.flip,
            ImageMetric::DeltaEItp => self.delta_e_itp,
        }
    }
}

impl ImageMetric {
    /// All of them, in the order of reports.
    pub const ALL: [Self; 6] = [Self::Mae, Self::Rmse, Self::Psnr, Self::Ssim, Self::Flip, Self::DeltaEItp];

    /// Key in reports, without the light.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mae => "mae",
            Self::Rmse => "rmse",
            Self::Psnr => "psnr",
            Self::Ssim => "ssim",
            Self::Flip => "flip",
            Self::DeltaEItp => "delta_e_itp",
        }
    }

    /// Whether larger means closer.
    pub const fn higher_is_better(self) -> bool {
        matches!(self, Self::Psnr | Self::Ssim)
    }

    /// This error alone of two *linear* pictures.
    ///
    /// # Panics
    /// If the pictures or the mask differ in size (a bug of the caller).
    pub fn distance(self, reference: &Image, other: &Image, covered: &[bool]) -> f64 {
        let shown =
            |error: fn(&Image, &Image, &[bool]) -> f64| error(&reference.displayed(), &other.displayed(), covered);
        match self {
            Self::Mae => shown(mae),
            Self::Rmse => shown(rmse),
            Self::Psnr => shown(psnr),
            Self::Ssim => shown(|f, g, _| ssim(f, g)),
            Self::Flip => shown(|f, g, _| flip(f, g)),
            Self::DeltaEItp => delta_e_itp(reference, other, covered),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;

    fn pictures() -> (Image, Image, Vec<bool>) {
        let picture = |scale: f32| {
            let pixel = |i: usize| Rgb([(i % 16) as f32, (i / 16) as f32, (i % 7) as f32]) * (scale / 16.0);
            Image::new(16, 16, (0..256).map(pixel).collect())
        };
        (picture(1.0), picture(0.8), (0..256).map(|i| i % 5 != 0).collect())
    }

    #[test]
    fn each_error_alone_is_the_same_as_together() {
        let (f, g, covered) = pictures();
        let together = image_errors(&f, &g, &covered);
        for metric in ImageMetric::ALL {
            assert_eq!(metric.distance(&f, &g, &covered), together.get(metric), "{}", metric.name());
        }
    }

    #[test]
    fn identical_pictures_have_the_best_of_each() {
        let (f, _, covered) = pictures();
        let errors = image_errors(&f, &f, &covered);
        assert_eq!((errors.mae, errors.rmse, errors.flip, errors.delta_e_itp), (0.0, 0.0, 0.0, 0.0));
        assert_eq!(errors.psnr, 100.0);
        assert!((errors.ssim - 1.0).abs() < 1e-12);
    }

    #[test]
    fn names_are_the_keys_of_the_serialized_errors() {
        let (f, g, covered) = pictures();
        let json = serde_json::to_value(image_errors(&f, &g, &covered)).unwrap();
        for metric in ImageMetric::ALL {
            assert!(json.get(metric.name()).is_some(), "{}", metric.name());
        }
    }
}
