//! A diffuse base alone: three numbers, ln k_d.

use super::Parametric;
use super::microfacet::solve_together;
use super::number::{of_positive, positive_rgb};
use super::target::Target;
use crate::Brdf;
use crate::brdf::lambert::Lambert;

/// Lambert's reflectance.
pub struct LambertAlone;

impl Parametric for LambertAlone {
    const NAME: &'static str = "lambert";
    const DIM: usize = 3;

    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf> {
        Box::new(Lambert { albedo: positive_rgb(numbers) })
    }

    fn fit(target: &Target) -> Vec<f32> {
        let start = Target::albedo(target.base()).map(of_positive).0.to_vec();
        solve_together::<Self>(target, &[start])
    }
}
