//! How far a fit is from its material.

use serde::{Deserialize, Serialize};

use crate::Brdf;
use crate::metric::{image_errors, log_error, relative_log};
use crate::render::Sphere;
use crate::sampling::{evaluate, rus32k};

/// Figures of PROTOCOL's metrics, of a fit against its material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FitErrors {
    /// See [`LogError`](crate::metric::LogError).
    pub log_error: f64,
    /// See [`RelativeLog`](crate::metric::RelativeLog).
    pub relative_log: f64,
    /// PSNR of spheres under light `studio` \[dB\].
    pub studio_psnr: f64,
    /// Mean ΔE_ITP of spheres under light `studio`.
    pub studio_delta_e_itp: f64,
}

impl FitErrors {
    /// Of `fit` against `material`.
    pub fn of(material: &dyn Brdf, fit: &dyn Brdf) -> Self {
        let at = rus32k();
        let [known, own] = [material, fit].map(|brdf| evaluate(brdf, at));
        let sphere = Sphere::studio();
        let images = image_errors(&sphere.render(material), &sphere.render(fit), sphere.covered());
        Self {
            log_error: log_error(at, &known, &own),
            relative_log: relative_log(at, &known, &own),
            studio_psnr: images.psnr,
            studio_delta_e_itp: images.delta_e_itp,
        }
    }
}
