//! `nbrdf blend`: spheres along the path between materials, one row per method.

mod samples;

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use clap::Args;
use nbrdf_core::metric::albedo_max;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Brdf, Image, Material, Warning};
use serde_json::{Value, json};

use super::Global;
use super::render::{LightName, stops};
use crate::catalog::{Catalog, INTERPOLATIONS, InterpolationEntry};
use crate::material::{Shelf, Sources};
use crate::strip::{Cell, Row, Strip, ground};
use crate::{output, progress, report};
use samples::{Sample, samples};

/// Walks between materials and draws the walk, one row per method.
#[derive(Debug, Args)]
pub struct Blend {
    /// Two or more materials: names, files of networks, codes.
    #[arg(required = true, num_args = 2.., value_name = "MATERIAL")]
    ends: Vec<String>,
    /// Places on the path: 0 is the first of two materials, 1 the second; for more materials one weight each (1,1,2).
    #[arg(long, num_args = 1.., value_name = "W", allow_negative_numbers = true)]
    at: Vec<String>,
    /// Number of even steps; 7 between two materials unless told otherwise. Through more materials, in order, steps
    /// follow a smooth curve (a spline).
    #[arg(long, value_name = "N", conflicts_with = "at", value_parser = clap::value_parser!(u16).range(2..=64))]
    steps: Option<u16>,
    /// Method to walk by; may be given again; all of them unless told otherwise.
    #[arg(long = "method", value_name = "M")]
    methods: Vec<String>,
    /// Picture to write: .png with labels, or .exr with nothing but the linear spheres.
    #[arg(short, long, value_name = "PICTURE", default_value = "blend.png")]
    output: PathBuf,
    /// Lights around the spheres.
    #[arg(long, value_enum, default_value_t = LightName::Studio)]
    light: LightName,
    /// Pixels per side of a sphere, 16 to 1024.
    #[arg(long, value_name = "N", default_value_t = 128, value_parser = clap::value_parser!(u16).range(16..=1024))]
    size: u16,
    /// Brighter by this many stops; negative is darker.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_negative_numbers = true, value_parser = stops)]
    exposure: f32,
    #[command(flatten)]
    sources: Sources,
}

/// What became of one method.
struct Walk {
    entry: &'static InterpolationEntry,
    result: Result<Walked>,
}

impl Walk {
    fn is_clamped(&self) -> bool {
        let said = self.result.iter().flat_map(|walked| walked.warnings.iter().flatten());
        said.into_iter().any(|warning| matches!(warning, Warning::EnergyClamped { .. }))
    }
}

/// The points of a walk.
struct Walked {
    spheres: Vec<Image>,
    albedo: f64,
    /// What the path says of every point.
    warnings: Vec<Vec<Warning>>,
    /// Distance of every point's code to known materials; none where the path walks through no codes of ZNBRDF.
    distances: Option<Vec<f64>>,
}

impl Blend {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let samples = samples(self.ends.len(), &self.at, self.steps)?;
        let methods = self.methods()?;
        output::check(&self.output, &output::PICTURES)?;
        let shelf = self.sources.open()?;
        let ends = self.ends(&shelf)?;
        if let Some((beyond, warning)) = samples.iter().find_map(|sample| Some((sample, sample.warning.clone()?))) {
            global.warn_of(&beyond.label, [warning])?;
        }
        let limit = ends.iter().map(|end| albedo_max(end.brdf.as_ref())).fold(1.0, f64::max);
        if limit > 1.0 {
            global.warn(format_args!("albedo_max of the materials is {limit:.3}: more light leaves than arrives"))?;
        }
        let mut walks = self.walk(&methods, &shelf.catalog, &ends, &samples, global);
        shelf.catalog.check_used()?;
        warn_of_methods(&walks, limit, global)?;
        if walks.iter().all(|walk| walk.result.is_err()) {
            let first = walks.swap_remove(0).result.err();
            return Err(first.unwrap_or_else(|| anyhow!("no method")));
        }
        self.write(&ends, &samples, &walks)?;
        report::print(global, &self.json(&ends, &samples, &walks), || {
            let drawn = walks.iter().filter(|walk| walk.result.is_ok()).count();
            format!("{drawn} methods, {} spheres each in {}\n", samples.len(), self.output.display())
        })
    }

    fn methods(&self) -> Result<Vec<&'static InterpolationEntry>> {
        if self.methods.is_empty() {
            return Ok(INTERPOLATIONS.iter().collect());
        }
        self.methods.iter().map(|name| Catalog::interpolation_entry(name)).collect()
    }

    fn ends(&self, shelf: &Shelf) -> Result<Vec<Material>> {
        self.ends.iter().map(|end| Ok(shelf.material_or_code(end)?.material)).collect()
    }

    fn walk(
        &self,
        methods: &[&'static InterpolationEntry],
        catalog: &Catalog,
        ends: &[Material],
        samples: &[Sample],
        global: &Global,
    ) -> Vec<Walk> {
        let painter = Painter::new(self);
        let bar = progress::bar(methods.len() as u64, "walking", global.quiet);
        let walks = methods.iter().map(|&entry| {
            bar.set_message(entry.name);
            let result = points(entry, catalog, ends, samples).map(|Points { points, warnings, distances }| Walked {
                albedo: points.iter().map(|brdf| albedo_max(brdf.as_ref())).fold(0.0, f64::max),
                spheres: points.iter().map(|brdf| painter.draw(brdf.as_ref())).collect(),
                warnings,
                distances,
            });
            bar.inc(1);
            Walk { entry, result }
        });
        let walks = walks.collect();
        bar.finish_and_clear();
        walks
    }

    fn write(&self, ends: &[Material], samples: &[Sample], walks: &[Walk]) -> Result<()> {
        let names: Vec<&str> = ends.iter().map(|end| end.name.as_str()).collect();
        let separator = if names.len() == 2 { " to " } else { ", " };
        let exposure = if self.exposure == 0.0 { String::new() } else { format!(", {:+} stops", self.exposure) };
        let row = |walk: &Walk| {
            let spheres = walk.result.as_ref().ok()?.spheres.clone();
            Some(Row { title: walk.entry.title.into(), name: walk.entry.name.into(), spheres })
        };
        let strip = Strip {
            heading: names.join(separator),
            remark: format!("{} light{exposure}", self.light.light().name),
            columns: samples.iter().map(|sample| sample.heading()).collect(),
            rows: walks.iter().filter_map(row).collect(),
        };
        let picture = if is_exr(&self.output) { strip.plain() } else { strip.labelled() };
        output::write_picture(&self.output, &picture)
    }

    fn json(&self, ends: &[Material], samples: &[Sample], walks: &[Walk]) -> Value {
        let method = |walk: &Walk| match &walk.result {
            Ok(walked) => {
                json!({
                    "name": walk.entry.name, "albedo_max": walked.albedo, "distances": walked.distances,
                    "warnings": walked.warnings,
                })
            }
            Err(error) => json!({"name": walk.entry.name, "failed": format!("{error:#}")}),
        };
        json!({
            "schema": 1,
            "materials": ends.iter().map(|end| &end.name).collect::<Vec<_>>(),
            "weights": samples.iter().map(|sample| sample.weights.as_slice()).collect::<Vec<_>>(),
            "light": self.light.light().name,
            "methods": walks.iter().map(method).collect::<Vec<_>>(),
            "output": self.output.display().to_string(),
        })
    }
}

/// For looking at, or for computing with.
enum Painter {
    Cell(Cell, f32),
    Exact(Sphere, f32),
}

impl Painter {
    fn new(blend: &Blend) -> Self {
        let (size, light, gain) = (usize::from(blend.size), blend.light.light(), blend.exposure.exp2());
        match is_exr(&blend.output) {
            true => Self::Exact(Sphere::new(size, &light), gain),
            false => Self::Cell(Cell::new(size, &light), gain),
        }
    }

    fn draw(&self, brdf: &dyn Brdf) -> Image {
        match self {
            Self::Cell(cell, gain) => cell.draw(brdf, *gain, ground()),
            Self::Exact(sphere, gain) => sphere.render(brdf).map(|pixel| pixel * *gain),
        }
    }
}

fn is_exr(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "exr")
}

/// What a walk passes, what it says of each point, and how far each code is from known ones.
struct Points {
    points: Vec<Box<dyn Brdf>>,
    warnings: Vec<Vec<Warning>>,
    distances: Option<Vec<f64>>,
}

fn points(entry: &InterpolationEntry, catalog: &Catalog, ends: &[Material], samples: &[Sample]) -> Result<Points> {
    let path = entry.build(catalog)?.between(ends)?;
    let known = catalog.autoencoder();
    let distance = |sample: &Sample| match path.code(&sample.weights)? {
        Some(code) => Ok(known.distance(&code)?),
        None => Ok(None),
    };
    Ok(Points {
        points: samples.iter().map(|sample| Ok(path.at(&sample.weights)?)).collect::<Result<_>>()?,
        warnings: samples.iter().map(|sample| Ok(path.warnings(&sample.weights)?)).collect::<Result<_>>()?,
        distances: samples.iter().map(distance).collect::<Result<_>>()?,
    })
}

/// Failures one by one; energy in one line, and only where the method is worse than the materials themselves.
fn warn_of_methods(walks: &[Walk], limit: f64, global: &Global) -> Result<()> {
    let mut bright = Vec::new();
    let clamped: Vec<&str> = walks.iter().filter(|walk| walk.is_clamped()).map(|walk| walk.entry.name).collect();
    if !clamped.is_empty() {
        global.warn(format_args!(
            "energy clamped: {} stop where more light would leave than arrives",
            clamped.join(", ")
        ))?;
    }
    for walk in walks {
        match &walk.result {
            Err(error) => global.warn(format_args!("{}: {error:#}", walk.entry.name))?,
            Ok(Walked { albedo, .. }) if *albedo > limit + 1e-3 => {
                bright.push(format!("{} ({albedo:.2})", walk.entry.name));
            }
            Ok(_) => {}
        }
    }
    match bright.is_empty() {
        true => Ok(()),
        false => global.warn(format_args!("more light leaves than arrives, by albedo_max: {}", bright.join(", "))),
    }
}
