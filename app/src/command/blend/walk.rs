//! The walk of one method, and what is said of it.

use anyhow::Result;
use nbrdf_core::metric::{albedo_max, reciprocity};
use nbrdf_core::{Brdf, Code, Image, Material, Warning};

use super::painter::Painter;
use super::samples::Sample;
use crate::catalog::{Catalog, InterpolationEntry};
use crate::command::Global;

/// What became of one method.
pub(super) struct Walk {
    pub entry: &'static InterpolationEntry,
    pub result: Result<Walked>,
}

impl Walk {
    /// Where it succeeded, the method and its points.
    pub fn success(&self) -> Option<(&'static InterpolationEntry, &Walked)> {
        Some((self.entry, self.result.as_ref().ok()?))
    }
}

/// The points of a walk.
pub(super) struct Walked {
    pub spheres: Vec<Image>,
    /// Largest of any point.
    pub albedo: f64,
    /// Largest of any point.
    pub reciprocity: f64,
    /// What the path says of every point.
    pub warnings: Vec<Vec<Warning>>,
    /// Every point's code; none where the path walks through no codes.
    pub codes: Vec<Option<Code>>,
    /// Distance of every point's code to known materials; none where the path walks through no codes of ZNBRDF.
    pub distances: Option<Vec<f64>>,
}

impl Walked {
    pub fn new(
        entry: &InterpolationEntry,
        catalog: &Catalog,
        ends: &[Material],
        samples: &[Sample],
        painter: &Painter,
    ) -> Result<Self> {
        let path = entry.build(catalog)?.between(ends)?;
        let known = catalog.autoencoder();
        let codes: Vec<Option<Code>> =
            samples.iter().map(|sample| Ok(path.code(&sample.weights)?)).collect::<Result<_>>()?;
        let distance = |code: &Option<Code>| match code {
            Some(code) => Ok(known.distance(code)?),
            None => Ok(None),
        };
        let points: Vec<Box<dyn Brdf>> =
            samples.iter().map(|sample| Ok(path.at(&sample.weights)?)).collect::<Result<_>>()?;
        let most = |figure: fn(&dyn Brdf) -> f64| points.iter().map(|brdf| figure(brdf.as_ref())).fold(0.0, f64::max);
        Ok(Self {
            albedo: most(albedo_max),
            reciprocity: most(reciprocity),
            spheres: points.iter().map(|brdf| painter.draw(brdf.as_ref())).collect(),
            warnings: samples.iter().map(|sample| Ok(path.warnings(&sample.weights)?)).collect::<Result<_>>()?,
            distances: codes.iter().map(distance).collect::<Result<_>>()?,
            codes,
        })
    }

    fn is_clamped(&self) -> bool {
        self.warnings.iter().flatten().any(|warning| matches!(warning, Warning::EnergyClamped { .. }))
    }
}

/// Failures one by one; what can be said of several methods in one line, energy and reciprocity only where a method is
/// worse than the materials themselves.
pub(super) fn warn(walks: &[Walk], [brightest, unequal]: [f64; 2], global: &Global) -> Result<()> {
    for walk in walks {
        if let Err(error) = &walk.result {
            global.warn(format_args!("{}: {error:#}", walk.entry.name))?;
        }
    }
    let tell = |what: &str, told: &dyn Fn(&Walked) -> Option<String>| {
        let all = walks.iter().filter_map(|walk| {
            let told = told(walk.result.as_ref().ok()?)?;
            Some(format!("{}{told}", walk.entry.name))
        });
        let all: Vec<String> = all.collect();
        if all.is_empty() { Ok(()) } else { global.warn(format_args!("{what}: {}", all.join(", "))) }
    };
    let above = |value: f64, limit: f64| (value > limit + 1e-3).then(|| format!(" ({value:.2})"));
    tell("energy clamped, more light would leave than arrives", &|walked| walked.is_clamped().then(String::new))?;
    tell("more light leaves than arrives, by albedo_max", &|walked| above(walked.albedo, brightest))?;
    tell("light and view exchanged give another reflectance, by reciprocity", &|walked| {
        above(walked.reciprocity, unequal)
    })
}
