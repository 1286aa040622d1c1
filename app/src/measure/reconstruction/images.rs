//! Whole pictures of a sphere, one to five.

use anyhow::Result;
use nbrdf_core::representation::EncodeError;
use nbrdf_core::representation::optimal_sampling::images::SphereImages;
use nbrdf_core::representation::optimal_sampling::log_relative::{LogRelative, SeenComponents};
use rayon::prelude::*;
use serde::Serialize;

use super::{Errors, Targets};

/// Most pictures.
pub const MOST: usize = 5;

/// So many pictures.
#[derive(Debug, Serialize)]
pub struct ImagesRow {
    /// How many.
    pub count: usize,
    /// Angles between light and viewer \[degrees\].
    pub lights: Vec<u32>,
    /// Lit pixels of all pictures.
    pub pixels: usize,
    /// Means over materials.
    #[serde(flatten)]
    pub errors: Errors,
}

/// All rows; `done` is called after each and may end the work.
pub fn images(
    targets: &Targets,
    basis: &LogRelative,
    seen: &SeenComponents,
    done: &dyn Fn() -> Result<()>,
) -> Result<Vec<ImagesRow>> {
    let images = SphereImages::new(basis);
    let row = |count: usize| {
        let lights = images.choose(count);
        let one = |(number, material): (usize, &&nbrdf_core::Material)| {
            let found = images.coefficients(material.brdf.as_ref(), &lights);
            let found = found.ok_or_else(|| EncodeError::NotFinite { material: material.name.clone() })?;
            Ok(targets.errors(number, &basis.predict(seen, &found)))
        };
        let errors = targets.materials.par_iter().enumerate().map(one).collect::<Result<Vec<Errors>>>()?;
        done()?;
        Ok(ImagesRow { count, pixels: images.pixels(&lights), lights, errors: Errors::mean(&errors) })
    };
    (1..=MOST).map(row).collect()
}
