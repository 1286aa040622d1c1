//! How far one material is from another, how it looks on the way, and whether it could exist.
//!
//! Three kinds of figures share this folder. Direction-space errors ([`LogError`], [`RelativeLog`]) compare
//! reflectances over [`rus32k`](crate::sampling::rus32k). Image errors ([`image_errors`]) compare two pictures of a
//! sphere; [`Rendered`] makes metrics of them. [`Physics`] and [`Smoothness`] look at one material, or one path.

mod delta_e_itp;
mod flip;
mod image_errors;
mod linear_errors;
mod log_error;
mod physics;
mod plane;
mod psnr;
mod relative_log;
mod rendered;
mod smoothness;
mod spread;
mod ssim;

pub(crate) use delta_e_itp::itp_and_slopes;
pub use delta_e_itp::{ItpImage, delta_e_itp, delta_e_itp_map};
pub(crate) use flip::flip_of_colors;
pub use flip::{Seen, flip, flip_map};
pub use image_errors::{ImageErrors, ImageMetric, image_errors};
pub use linear_errors::LinearErrors;
pub use log_error::{LogError, log_error, log_error_estimate};
pub use physics::{Physics, albedo_max, albedo_max_around, directional_albedo, negative_share, reciprocity};
pub use psnr::{PSNR_CAP, mae, psnr, rmse};
pub use relative_log::{RelativeLog, relative_log};
pub use rendered::Rendered;
pub use smoothness::{Smoothness, detour, distance_from_segment, hue_excursion, mean_chromaticity};
pub(crate) use smoothness::{change_of_detour, chromaticity_and_slopes};
pub use spread::{Spread, badness};
pub use ssim::ssim;

use crate::Brdf;

/// A number for how far `other` is from `reference`.
pub trait Metric: Send + Sync {
    /// Key in reports: `log_error`, `studio_psnr`, ...
    fn name(&self) -> &'static str;

    /// The figure; range and unit are those of the metric.
    fn distance(&self, reference: &dyn Brdf, other: &dyn Brdf) -> f64;

    /// Whether larger means closer, as for PSNR and SSIM.
    fn higher_is_better(&self) -> bool {
        false
    }
}
