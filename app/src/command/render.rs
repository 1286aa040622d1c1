//! `nbrdf render`: a sphere of a material.

pub(crate) mod lights;
mod surroundings;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use lights::{LightName, Lights};
use nbrdf_core::render::Sphere;
use serde_json::json;
use surroundings::Surroundings;

use super::{Global, of_code};
use crate::material::Sources;
use crate::measure::guard;
use crate::{output, report};

/// Renders a sphere of a material: .png as a display shows it, .exr with the linear values.
#[derive(Debug, Args)]
pub struct Render {
    /// Name of a material, the file of a network, or a code (`-` for standard input).
    #[arg(value_name = "MATERIAL|FILE|CODE")]
    material: String,
    /// Picture to write: .png or .exr.
    #[arg(short, long, value_name = "PICTURE")]
    output: PathBuf,
    /// Lights around the sphere.
    #[arg(long, value_parser = Lights, default_value_t = LightName::Studio)]
    light: LightName,
    /// Pixels per side, 1 to 4096.
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u16).range(1..=4096))]
    size: u16,
    /// Brighter by this many stops; negative is darker.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_negative_numbers = true, value_parser = stops)]
    exposure: f32,
    #[command(flatten)]
    surroundings: Surroundings,
    #[command(flatten)]
    sources: Sources,
}

/// Exposure in stops, within what a picture can show.
pub fn stops(text: &str) -> Result<f32, String> {
    let stops: f32 = text.parse().map_err(|_| "expected a number of stops".to_owned())?;
    if (-20.0..=20.0).contains(&stops) { Ok(stops) } else { Err("expected -20 to 20 stops".to_owned()) }
}

impl Render {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        output::check(&self.output, &output::PICTURES)?;
        let environment = self.surroundings.open()?;
        let shelf = self.sources.open()?;
        let item = shelf.any(&self.material)?;
        shelf.catalog.check_used()?;
        let energy = guard::of_energy(item.albedo_max());
        let (source, used) =
            (guard::of_source(item.material.brdf.as_ref()), guard::of_use(item.material.brdf.as_ref()));
        let told = of_code(&item, &shelf)?.into_iter().chain(source).chain(energy).chain(used);
        global.warn_of(&item.material.name, told)?;
        let light = self.light.light();
        let lamps_only = environment.is_none();
        let picture = match environment {
            Some(around) => self.surroundings.render(around, (&item, &shelf), self.size.into(), global)?,
            None => Sphere::new(self.size.into(), &light).render(item.material.brdf.as_ref()),
        };
        let gain = self.exposure.exp2();
        output::write_picture(&self.output, &picture.map(|pixel| pixel * gain))?;
        let summary = json!({
            "schema": 1, "material": item.material.name, "light": lamps_only.then_some(light.name),
            "environment": self.surroundings.summary(global), "size": self.size, "exposure": self.exposure,
            "output": self.output.display().to_string(),
        });
        report::print(global, &summary, || format!("{} in {}\n", item.material.name, self.output.display()))
    }
}
