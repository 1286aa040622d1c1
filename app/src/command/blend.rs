//! `nbrdf blend`: spheres along the path between materials, one row per method.

mod code;
mod painter;
mod sample;
pub(crate) mod samples;
mod summary;
mod walk;

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use clap::Args;
use nbrdf_core::Material;
use nbrdf_core::metric::{albedo_max, reciprocity};
use nbrdf_core::stress::directions::undecided;

use super::render::lights::{LightName, Lights};
use super::render::stops;
use super::{Global, names};
use crate::catalog::{Catalog, INTERPOLATIONS, InterpolationEntry};
use crate::material::{Shelf, Sources};
use crate::measure::guard;
use crate::strip::{Row, Strip};
use crate::{output, progress, report};
use painter::{Painter, is_exr};
use samples::{Sample, samples};
use walk::{Walk, Walked};

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
    #[arg(long = "method", value_name = "M", value_parser = names::interpolations())]
    methods: Vec<String>,
    /// Picture to write: .png with labels, or .exr with nothing but the linear spheres.
    #[arg(short, long, value_name = "PICTURE", default_value = "blend.png")]
    output: PathBuf,
    /// Write the code of the place too: of one method that walks through codes, and one place.
    #[arg(long, value_name = "CODE")]
    code: Option<PathBuf>,
    /// Lights around the spheres.
    #[arg(long, value_parser = Lights, default_value_t = LightName::Studio)]
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

impl Blend {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let samples = samples(self.ends.len(), &self.at, self.steps)?;
        let methods = self.methods()?;
        output::check(&self.output, &output::PICTURES)?;
        if let Some(path) = &self.code {
            code::check(path, &self.ends, &methods, &samples)?;
        }
        let shelf = self.sources.open()?;
        let ends = self.ends(&shelf)?;
        if let Some((beyond, warning)) = samples.iter().find_map(|sample| Some((sample, sample.warning.clone()?))) {
            global.warn_of(&beyond.label, [warning])?;
        }
        let limits = self.limits(&ends, global)?;
        let mut walks = self.walk(&methods, &shelf.catalog, &ends, &samples, global);
        shelf.catalog.check_used()?;
        walk::warn(&walks, limits, global)?;
        if walks.iter().all(|walk| walk.result.is_err()) {
            let first = walks.swap_remove(0).result.err();
            return Err(first.unwrap_or_else(|| anyhow!("no method")));
        }
        if let (Some(path), Some((entry, walked))) = (&self.code, walks.iter().find_map(Walk::success)) {
            code::write(path, entry, walked, &ends, &samples)?;
        }
        self.write(&ends, &samples, &walks)?;
        report::print(global, &self.json(&ends, &samples, &walks), || {
            let drawn = walks.iter().filter(|walk| walk.result.is_ok()).count();
            let [methods, spheres] = [(drawn, "method"), (samples.len(), "sphere")]
                .map(|(count, what)| format!("{count} {what}{}", if count == 1 { "" } else { "s" }));
            format!("{methods}, {spheres} each in {}\n", self.output.display())
        })
    }

    /// Albedo and reciprocity that walks may have: what is usual, or what the materials have themselves, which is told.
    fn limits(&self, ends: &[Material], global: &Global) -> Result<[f64; 2]> {
        let mut limits = [1.0, guard::UNEQUAL];
        for Material { name, brdf, .. } in ends {
            let brdf = brdf.as_ref();
            let own = [albedo_max(brdf), reciprocity(brdf)];
            let told = guard::of_source(brdf).chain(guard::of_energy(own[0])).chain(guard::of_reciprocity(own[1]));
            global.warn_of(name, told.chain(undecided(brdf)))?;
            limits = [0, 1].map(|figure| f64::max(limits[figure], own[figure]));
        }
        Ok(limits)
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
            let result = Walked::new(entry, catalog, ends, samples, &painter);
            bar.inc(1);
            Walk { entry, result }
        });
        let walks = walks.collect();
        bar.finish_and_clear();
        walks
    }

    fn write(&self, ends: &[Material], samples: &[Sample], walks: &[Walk]) -> Result<()> {
        let names: Vec<&str> = ends.iter().map(|end| end.name.as_str()).collect();
        let row = |walk: &Walk| {
            let spheres = walk.result.as_ref().ok()?.spheres.clone();
            Some(Row { title: walk.entry.title.into(), name: walk.entry.name.into(), spheres })
        };
        let strip = Strip {
            heading: Strip::heading_of(&names),
            remark: Strip::remark_of(self.light.light().name, self.exposure),
            columns: samples.iter().map(|sample| sample.heading()).collect(),
            rows: walks.iter().filter_map(row).collect(),
        };
        let picture = if is_exr(&self.output) { strip.plain() } else { strip.labelled() };
        output::write_picture(&self.output, &picture)
    }
}
