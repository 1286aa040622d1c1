//! How much samplers vary on every material: uniform, cosine, fitted lobes, and the lobe that a code predicts.

use anyhow::{Context, Result};
use autoencoder::Autoencoder;
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::sampler::variance::{Variances, relative_variance};
use nbrdf_core::{Material, Representation, Split};
use rayon::prelude::*;
use serde::Serialize;

/// One material's row.
#[derive(Debug, Serialize)]
pub struct SamplingRow {
    /// Of uniform, cosine, Blinn-Phong and the lobe fitted to the material.
    #[serde(flatten)]
    pub variances: Variances,
    /// Of the lobe predicted from the code.
    pub predicted: f64,
    /// That lobe.
    pub predicted_lobe: Lobe,
    /// Whether the autoencoder has not seen the material.
    pub held_out: bool,
}

/// The row of every material, in parallel, lobes predicted from the codes that `encoder` makes for `znbrdf`; `done` is
/// called after each.
pub fn sampling(
    materials: &[&Material],
    encoder: &dyn Representation,
    znbrdf: &Autoencoder,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<SamplingRow>> {
    let row = |material: &&Material| {
        let predicted_lobe = znbrdf.lobe(&encoder.encode(material)?)?.context("the checkpoint has learned no lobes")?;
        let row = SamplingRow {
            variances: Variances::of(&material.name, material.brdf.as_ref()),
            predicted: relative_variance(material.brdf.as_ref(), &predicted_lobe),
            predicted_lobe,
            held_out: Split::of(&material.name) == Split::HeldOut,
        };
        done();
        Ok(row)
    };
    materials.par_iter().map(row).collect()
}
