//! Image errors as metrics of materials: both are rendered on the standard sphere first.

use super::{ImageMetric, Metric};
use crate::{Brdf, render::Sphere};

/// An image error of 128 × 128 spheres under one of the standard lights.
///
/// Renders both materials at every call; where several errors of one pair are wanted, render once and use
/// [`image_errors`](super::image_errors()).
#[derive(Clone, Copy, Debug)]
pub struct Rendered {
    name: &'static str,
    sphere: fn() -> &'static Sphere,
    metric: ImageMetric,
}

impl Rendered {
    /// Under light `point`: `point_psnr`, ...
    pub const fn point(metric: ImageMetric) -> Self {
        let name = match metric {
            ImageMetric::Mae => "point_mae",
            ImageMetric::Rmse => "point_rmse",
            ImageMetric::Psnr => "point_psnr",
            ImageMetric::Ssim => "point_ssim",
            ImageMetric::Flip => "point_flip",
            ImageMetric::DeltaEItp => "point_delta_e_itp",
        };
        Self { name, sphere: Sphere::point, metric }
    }

    /// Under light `studio`: `studio_psnr`, ...
    pub const fn studio(metric: ImageMetric) -> Self {
        let name = match metric {
            ImageMetric::Mae => "studio_mae",
            ImageMetric::Rmse => "studio_rmse",
            ImageMetric::Psnr => "studio_psnr",
            ImageMetric::Ssim => "studio_ssim",
            ImageMetric::Flip => "studio_flip",
            ImageMetric::DeltaEItp => "studio_delta_e_itp",
        };
        Self { name, sphere: Sphere::studio, metric }
    }

    /// Every image error under both lights.
    pub fn all() -> impl Iterator<Item = Self> {
        ImageMetric::ALL.into_iter().flat_map(|metric| [Self::point(metric), Self::studio(metric)])
    }
}

impl Metric for Rendered {
    fn name(&self) -> &'static str {
        self.name
    }

    fn distance(&self, reference: &dyn Brdf, other: &dyn Brdf) -> f64 {
        let sphere = (self.sphere)();
        self.metric.distance(&sphere.render(reference), &sphere.render(other), sphere.covered())
    }

    fn higher_is_better(&self) -> bool {
        self.metric.higher_is_better()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rgb, brdf::lambert::Lambert};

    #[test]
    fn names_are_light_and_error() {
        for rendered in Rendered::all() {
            let light = (rendered.sphere)().light().name;
            assert_eq!(rendered.name(), format!("{light}_{}", rendered.metric.name()));
        }
    }

    #[test]
    fn every_image_metric_tells_a_closer_grey_from_a_farther_one() {
        let grey = |albedo: f32| Lambert { albedo: Rgb::splat(albedo) };
        for rendered in Rendered::all() {
            let near = rendered.distance(&grey(0.5), &grey(0.45));
            let far = rendered.distance(&grey(0.5), &grey(0.2));
            assert_eq!(near > far, rendered.higher_is_better(), "{}: {near} {far}", rendered.name());
        }
    }
}
