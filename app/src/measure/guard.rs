//! What is to be said of a result: warnings of reflectances and codes, the same for command line, app and stress test.

use autoencoder::Autoencoder;
use nbrdf_core::metric::{albedo_max, directional_albedo, negative_share, reciprocity};
use nbrdf_core::representation::DecodeError;
use nbrdf_core::{Brdf, Code, Material, Warning};

use super::Trust;

/// Codes of ZNBRDF that are farther from those of training, in distances between neighbours among these, are of no
/// material: measured ones stay below 6.
const FARTHEST: f64 = 20.0;

/// A reflectance that could not exist.
pub fn of_energy(albedo_max: f64) -> Option<Warning> {
    // No number is no trust.
    (albedo_max.is_nan() || albedo_max > 1.0).then_some(Warning::EnergyGained { albedo_max })
}

/// A code that no material has.
pub fn of_distance(code: &Code, known: &Autoencoder) -> Result<Option<Warning>, DecodeError> {
    let distance = known.distance(code)?;
    Ok(distance.filter(|d| d.is_nan() || *d > FARTHEST).map(|distance| Warning::FarFromTraining { distance }))
}

/// How different reflectances may be with light and view exchanged, and on which share of directions they may be below zero
/// before they are clamped.
const UNEQUAL: f64 = 0.2;
const NEGATIVE: f64 = 0.05;

/// A reflectance that differs with light and view exchanged.
pub fn of_reciprocity(brdf: &dyn Brdf) -> Option<Warning> {
    let reciprocity = reciprocity(brdf);
    (reciprocity.is_nan() || reciprocity > UNEQUAL).then_some(Warning::NotReciprocal { reciprocity })
}

/// All that a reflectance says of itself.
pub fn of_reflectance(brdf: &dyn Brdf) -> Vec<Warning> {
    let share = negative_share(brdf);
    let negative = (share > NEGATIVE).then_some(Warning::Negative { share });
    of_energy(albedo_max(brdf)).into_iter().chain(of_reciprocity(brdf)).chain(negative).collect()
}

/// Albedos at normal incidence of materials: obsidian, the darkest of MERL, has 0.005.
const ALBEDOS: [f64; 2] = [0.004, 1.0];

/// A material darker or brighter than any that was learned from.
pub fn of_brightness(brdf: &dyn Brdf) -> Option<Warning> {
    let [low, high] = ALBEDOS;
    let found = f64::from(directional_albedo(brdf, 0.0).max());
    let is_usual = (low..=high).contains(&found);
    (!is_usual).then_some(Warning::OutOfRange { what: "the albedo at normal incidence", found, low, high })
}

/// All that is to be said of the code of a material, and of what it decodes to.
pub fn of_encoded(
    material: &Material,
    code: &Code,
    decoded: &dyn Brdf,
    known: &Autoencoder,
) -> Result<Vec<Warning>, DecodeError> {
    let carried = Trust::of(material, code, decoded, known)?.warning();
    let distance = of_distance(code, known)?;
    let brightness = of_brightness(material.brdf.as_ref());
    Ok(carried.into_iter().chain(distance).chain(brightness).chain(of_reflectance(decoded)).collect())
}

/// Condition numbers up to which measurements tell the coefficients of measured materials; all cells of a table have 1500.
const WELL_CONDITIONED: f64 = 5000.0;

/// Measurements that tell too little.
pub fn of_condition(kappa: f64, samples: usize) -> Option<Warning> {
    (kappa.is_nan() || kappa > WELL_CONDITIONED).then_some(Warning::IllConditioned { kappa, samples })
}

/// Numbers of a fit for each that is measured, three of them a sample: fewer leave some to chance.
pub fn of_samples(samples: usize, numbers: usize) -> Option<Warning> {
    let low = numbers.div_ceil(3) as f64;
    let found = samples as f64;
    (found < low).then_some(Warning::OutOfRange { what: "the number of samples", found, low, high: f64::INFINITY })
}
