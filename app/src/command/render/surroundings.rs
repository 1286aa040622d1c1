//! `nbrdf render --environment`: light from all around, sample after sample.

use std::path::Path;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use nbrdf_core::render::{Environment, Progressive};
use nbrdf_core::sampler::{Sampler, cosine::Cosine, lobe::Lobe, uniform::Uniform};
use nbrdf_core::{Image, Representation};
use serde_json::{Value, json};

use crate::command::Global;
use crate::failure::Failure;
use crate::input;
use crate::material::{Item, Shelf};
use crate::progress;

/// The environment that a sphere stands in, and the effort spent on it.
#[derive(Debug, Args)]
pub struct Surroundings {
    /// Light from all around instead of lamps: a map in latitude and longitude (.hdr or .exr), or `softboxes`.
    #[arg(long, value_name = "MAP", conflicts_with = "light")]
    environment: Option<String>,
    /// Turn of the environment about the vertical axis; light from the viewer's side goes to the right.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_negative_numbers = true, value_parser = degrees)]
    #[arg(requires = "environment", conflicts_with = "light")]
    rotate: f64,
    /// Samples per pixel under an environment, 1 to 65536; four times as many halve the noise, or better.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=65536))]
    #[arg(requires = "environment", conflicts_with = "light")]
    samples: u32,
    /// How lights are drawn for the material, beside those of the environment.
    #[arg(long, value_enum, default_value_t = SamplerName::Lobe, requires = "environment", conflicts_with = "light")]
    sampler: SamplerName,
}

/// The samplers, from good to bad.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum SamplerName {
    /// Predicted from a code, fitted to anything else.
    Lobe,
    /// In proportion to the cosine.
    Cosine,
    /// Everywhere alike.
    Uniform,
}

impl SamplerName {
    fn of(self, item: &Item, shelf: &Shelf) -> Result<Box<dyn Sampler>> {
        Ok(match self {
            Self::Lobe => Box::new(lobe(item, shelf)?),
            Self::Cosine => Box::new(Cosine),
            Self::Uniform => Box::new(Uniform),
        })
    }
}

fn degrees(text: &str) -> Result<f64, String> {
    let degrees: f64 = text.parse().map_err(|_| "expected a number of degrees".to_owned())?;
    if (-360.0..=360.0).contains(&degrees) { Ok(degrees) } else { Err("expected -360 to 360 degrees".to_owned()) }
}

impl Surroundings {
    /// The environment asked for, turned; none without `--environment`.
    pub fn open(&self) -> Result<Option<Environment>> {
        let open = |name: &String| Ok(open(name)?.rotated(self.rotate.to_radians()));
        self.environment.as_ref().map(open).transpose()
    }

    /// What the report says of it; null without `--environment`.
    pub fn summary(&self, global: &Global) -> Option<Value> {
        let map = self.environment.as_ref()?;
        Some(json!({"map": map, "rotate": self.rotate, "samples": self.samples, "seed": global.seed()}))
    }

    /// The picture after all samples; Ctrl-C ends it between two of them.
    pub fn render(
        &self,
        environment: Environment,
        (item, shelf): (&Item, &Shelf),
        size: usize,
        global: &Global,
    ) -> Result<Image> {
        let sampler = self.sampler.of(item, shelf)?;
        let mut picture = Progressive::new(size, environment, global.seed());
        let bar = progress::bar(self.samples.into(), "rendering", global.quiet);
        while picture.passes() < self.samples {
            if progress::cancelled() {
                bail!("cancelled after {} of {} samples: nothing was written", picture.passes(), self.samples);
            }
            picture.pass(item.material.brdf.as_ref(), sampler.as_ref());
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(picture.image())
    }
}

/// A built-in environment by its name, else a map by its path.
fn open(name: &str) -> Result<Environment> {
    if let Some(built_in) = Environment::by_name(name) {
        return Ok(built_in);
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        let known = Environment::NAMES.join("`, `");
        let said = format!("no environment `{name}`: expected `{known}`, or a map (.hdr or .exr)");
        return Err(Failure::Usage(said).into());
    }
    input::check_file(path, "a map of light (.hdr or .exr)")?;
    Ok(Environment::load(path)?)
}

/// How lights are drawn: a code knows its lobe, to anything else one is fitted (some milliseconds).
fn lobe(item: &Item, shelf: &Shelf) -> Result<Lobe> {
    if let Some(code) = &item.code {
        let znbrdf = shelf.catalog.autoencoder();
        if code.model == znbrdf.name()
            && let Some(lobe) = znbrdf.lobe(code)?
        {
            return Ok(lobe);
        }
    }
    Ok(Lobe::fit(item.material.brdf.as_ref()))
}
