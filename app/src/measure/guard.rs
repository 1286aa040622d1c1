//! What is to be said of a result: warnings of reflectances and codes, the same for command line, app and stress test.

use std::any::Any;

use autoencoder::Autoencoder;
use nbrdf_core::brdf::table::Table;
use nbrdf_core::metric::{albedo_max, directional_albedo, negative_share, reciprocity};
use nbrdf_core::representation::DecodeError;
use nbrdf_core::stress::directions::undecided;
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

/// How different reflectances may be with light and view exchanged.
pub const UNEQUAL: f64 = 0.2;
/// On which share of the directions they may be below zero before they are clamped.
const NEGATIVE: f64 = 0.05;

/// A reflectance that differs with light and view exchanged.
pub fn of_reciprocity(reciprocity: f64) -> Option<Warning> {
    (reciprocity.is_nan() || reciprocity > UNEQUAL).then_some(Warning::NotReciprocal { reciprocity })
}

/// What is wrong with a reflectance that somebody is going to use.
pub fn of_result(brdf: &dyn Brdf) -> impl Iterator<Item = Warning> {
    of_energy(albedo_max(brdf)).into_iter().chain(of_use(brdf))
}

/// The same, of which the energy is known already.
pub fn of_use(brdf: &dyn Brdf) -> impl Iterator<Item = Warning> {
    of_reciprocity(reciprocity(brdf)).into_iter().chain(undecided(brdf))
}

/// All that a reflectance says of itself, wherever it is looked at.
pub fn of_reflectance(brdf: &dyn Brdf) -> Vec<Warning> {
    let share = negative_share(brdf);
    let negative = (share > NEGATIVE).then_some(Warning::Negative { share });
    of_energy(albedo_max(brdf)).into_iter().chain(of_reciprocity(reciprocity(brdf))).chain(negative).collect()
}

/// Albedos at normal incidence of materials: obsidian, the darkest of MERL, has 0.005.
const ALBEDOS: [f64; 2] = [0.004, 1.0];

/// Share of the cells above the horizon below which much of a table is made up of what is beside its gaps.
const MEASURED: f64 = 0.8;

/// All that a material says of itself before anything is made of it.
pub fn of_source(brdf: &dyn Brdf) -> impl Iterator<Item = Warning> {
    of_brightness(brdf).into_iter().chain(of_gaps(brdf))
}

/// A table of which much was not measured.
fn of_gaps(brdf: &dyn Brdf) -> Option<Warning> {
    let table = (brdf as &dyn Any).downcast_ref::<Table>()?;
    let found = table.measured_share();
    (found < MEASURED).then_some(Warning::OutOfRange {
        what: "the share of the table that was measured",
        found,
        low: MEASURED,
        high: 1.0,
    })
}

/// A material darker or brighter than any that was learned from.
fn of_brightness(brdf: &dyn Brdf) -> Option<Warning> {
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
    let source = of_source(material.brdf.as_ref());
    Ok(carried.into_iter().chain(distance).chain(source).chain(of_reflectance(decoded)).collect())
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

#[cfg(test)]
mod tests {
    use nbrdf_core::Rgb;
    use nbrdf_core::brdf::ggx::Ggx;
    use nbrdf_core::stress::damage::DAMAGES;

    use super::*;

    #[test]
    fn a_table_with_large_gaps_is_told_and_no_other() {
        let glossy = Ggx { diffuse: Rgb([0.2, 0.15, 0.1]), f0: Rgb::splat(0.5), alpha: 0.1 };
        for damage in &DAMAGES {
            let told = of_gaps(&damage.measured(&glossy, 0));
            assert_eq!(told.is_some(), damage.hazard.name == "missing", "{}: {told:?}", damage.hazard.name);
        }
        assert_eq!(of_gaps(&glossy), None);
    }
}
