//! How good one method's path between two materials is (PROTOCOL, "Interpolation quality").

use std::collections::BTreeMap;

use anyhow::Result;
use nbrdf_core::metric::{ImageErrors, Smoothness, albedo_max, image_errors, log_error, negative_share};
use nbrdf_core::path::mix::Mix;
use nbrdf_core::render::Sphere;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Interpolation, Material, Weights};

/// Steps from one end to the other.
const STEPS: i16 = 16;
/// Steps beyond each end.
const BEYOND: i16 = 8;

/// The figures of one method on one pair, by key.
///
/// `albedo_max` and `negative_share` are the worst over t in \[0, 1\], with `_beyond` over t in \[−½, 1½\].
pub fn path_quality(method: &dyn Interpolation, ends: &[Material; 2]) -> Result<BTreeMap<&'static str, f64>> {
    let path = method.between(ends)?;
    let sphere = Sphere::studio();
    let (mut pictures, mut end_errors) = (Vec::new(), Vec::new());
    let [mut negative, mut negative_beyond, mut albedo, mut albedo_beyond] = [0.0f64; 4];
    for step in -BEYOND..=STEPS + BEYOND {
        let brdf = path.at(&Weights::two(f32::from(step) / f32::from(STEPS)))?;
        let (share, energy) = (negative_share(brdf.as_ref()), albedo_max(brdf.as_ref()));
        negative_beyond = negative_beyond.max(share);
        albedo_beyond = albedo_beyond.max(energy);
        if (0..=STEPS).contains(&step) {
            (negative, albedo) = (negative.max(share), albedo.max(energy));
            pictures.push(sphere.render(brdf.as_ref()));
        }
        if step == 0 || step == STEPS {
            let end = &ends[usize::from(step == STEPS)];
            let values = evaluate(end.brdf.as_ref(), rus32k());
            end_errors.push(log_error(rus32k(), &values, &evaluate(brdf.as_ref(), rus32k())));
        }
    }
    let mixed = Mix::Linear.between(ends)?.at(&Weights::two(0.5))?;
    let middle = &pictures[usize::from(STEPS.unsigned_abs()) / 2];
    let ImageErrors { psnr, ssim, rmse, .. } = image_errors(&sphere.render(mixed.as_ref()), middle, sphere.covered());
    let Smoothness { length_ratio, step_ratio, hue_excursion } = Smoothness::of(&pictures, sphere.covered());
    Ok(BTreeMap::from([
        ("end_error", end_errors.iter().sum::<f64>() / 2.0),
        ("mix_psnr", psnr),
        ("mix_ssim", ssim),
        ("mix_rmse", rmse),
        ("length_ratio", length_ratio),
        ("step_ratio", step_ratio),
        ("hue_excursion", hue_excursion),
        ("negative_share", negative),
        ("negative_share_beyond", negative_beyond),
        ("albedo_max", albedo),
        ("albedo_max_beyond", albedo_beyond),
    ]))
}
