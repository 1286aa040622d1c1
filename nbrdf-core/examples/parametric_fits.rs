//! How far standard shading models are from measured materials: each of MERL's and RGL's published networks as a glTF
//! material, an OpenPBR surface and a Principled BSDF. Prints JSON: per database and model the errors' spreads with the
//! five worst materials, and how many materials use which part of the model.
//!
//!     cargo run --release -p nbrdf-core --example parametric_fits > docs/parametric.json

use std::collections::BTreeMap;
use std::error::Error;

use nbrdf_core::metric::Spread;
use nbrdf_core::parametric::{FitErrors, Fitted, GltfPbr, OpenPbr, Principled, ShadingModel, fit};
use nbrdf_core::{Library, Material, data};
use serde_json::{Value, json};

/// A figure of a fit: its name, how it is read, and whether higher is better.
type Figure = (&'static str, fn(&FitErrors) -> f64, bool);

const FIGURES: [Figure; 4] = [
    ("log_error", |errors| errors.log_error, false),
    ("relative_log", |errors| errors.relative_log, false),
    ("studio_psnr", |errors| errors.studio_psnr, true),
    ("studio_delta_e_itp", |errors| errors.studio_delta_e_itp, false),
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut databases = serde_json::Map::new();
    for (database, file) in [("merl", "merl_nbrdf.zip"), ("rgl", "rgl_nbrdf_subset.zip")] {
        let path = data::published(file).ok_or(format!("{file} is not in {}", data::folder().display()))?;
        let materials = Library::load(&path)?.materials();
        let models = [
            (GltfPbr::NAME, table::<GltfPbr>(&materials)?),
            (OpenPbr::NAME, table::<OpenPbr>(&materials)?),
            (Principled::NAME, table::<Principled>(&materials)?),
        ];
        databases.insert(database.to_owned(), models.into_iter().collect());
    }
    let command = "cargo run --release -p nbrdf-core --example parametric_fits > docs/parametric.json";
    println!("{:#}", json!({ "schema": 1, "command": command, "databases": databases }));
    Ok(())
}

/// Fits all materials.
fn table<M: ShadingModel>(materials: &[Material]) -> Result<Value, Box<dyn Error>> {
    let one = |material: &Material| -> Result<(String, Fitted<M>), String> {
        let fitted = fit::<M>(material.brdf.as_ref()).ok_or(format!("{} is not finite", material.name))?;
        eprintln!("{} {}: {:?}", M::NAME, material.name, fitted.errors);
        Ok((material.name.clone(), fitted))
    };
    let fits = materials.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let mut parts = BTreeMap::new();
    fits.iter().flat_map(|(_, fitted)| &fitted.parts).for_each(|part| *parts.entry(*part).or_insert(0) += 1);
    let mut table = json!({ "materials": fits.len(), "parts": parts });
    for (name, figure, higher_is_better) in FIGURES {
        let values = fits.iter().map(|(name, fitted)| (name.clone(), figure(&fitted.errors)));
        table[name] = json!(Spread::new(values, higher_is_better));
    }
    Ok(table)
}
