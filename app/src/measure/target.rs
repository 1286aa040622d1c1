//! A material that others are measured against: evaluated and rendered once.

use std::collections::BTreeMap;

use nbrdf_core::metric::{ImageMetric, Physics, image_errors, log_error, relative_log};
use nbrdf_core::render::Sphere;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Brdf, Image, Rgb};

use crate::catalog;

/// Reference values and pictures of one material.
pub struct Target {
    values: Vec<Rgb>,
    pictures: [Image; 2],
}

/// The standard spheres, with the prefix of their keys.
fn spheres() -> [&'static Sphere; 2] {
    [Sphere::point(), Sphere::studio()]
}

impl Target {
    /// Evaluates and renders `reference`.
    pub fn new(reference: &dyn Brdf) -> Self {
        Self { values: evaluate(reference, rus32k()), pictures: spheres().map(|sphere| sphere.render(reference)) }
    }

    /// All figures of a candidate by key: direction space, both lights, physics.
    pub fn figures(&self, candidate: &dyn Brdf) -> BTreeMap<String, f64> {
        let values = evaluate(candidate, rus32k());
        let mut figures = BTreeMap::new();
        figures.insert("log_error".to_owned(), log_error(rus32k(), &self.values, &values));
        figures.insert("relative_log".to_owned(), relative_log(rus32k(), &self.values, &values));
        for (sphere, picture) in spheres().into_iter().zip(&self.pictures) {
            let errors = image_errors(picture, &sphere.render(candidate), sphere.covered());
            for metric in ImageMetric::ALL {
                figures.insert(format!("{}_{}", sphere.light().name, metric.name()), errors.get(metric));
            }
        }
        let physics = Physics::of(candidate);
        figures.insert("negative_share".to_owned(), physics.negative_share);
        figures.insert("albedo_max".to_owned(), physics.albedo_max);
        figures.insert("reciprocity".to_owned(), physics.reciprocity);
        figures
    }
}

/// Whether larger is closer for this key.
pub fn higher_is_better(key: &str) -> bool {
    let metric = catalog::metrics().iter().any(|metric| metric.name() == key && metric.higher_is_better());
    metric || matches!(key, "mix_psnr" | "mix_ssim")
}
