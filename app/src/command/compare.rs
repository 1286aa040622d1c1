//! `nbrdf compare`: how good the ways between materials are, over the standard pairs and the families.

mod text;
mod worst;

use std::collections::BTreeMap;
use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;
use nbrdf_core::metric::Spread;
use nbrdf_core::{Database, Interpolation, Material};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::{Global, names};
use crate::catalog::{Catalog, INTERPOLATIONS, Reference};
use crate::measure::families::{Family, FamilyLobe, FittedFamily};
use crate::measure::path_quality::path_quality;
use crate::measure::{higher_is_better, standard_pairs};
use crate::{output, progress, report};

/// Measures interpolations over the standard pairs: (i, i + 37) of the sorted MERL names.
#[derive(Debug, Args)]
pub struct Compare {
    /// Methods to measure; all by default.
    #[arg(long = "method", value_name = "M", value_parser = names::interpolations())]
    methods: Vec<String>,
    /// Materials to walk between; the published networks in NBRDF_DATA by default, else the built-in ones.
    #[arg(long, value_name = "LIBRARY")]
    reference: Option<PathBuf>,
    /// Another ZNBRDF checkpoint than the built-in one, or a basis of pca_tables, pca_weights or charting_15.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Option<PathBuf>,
    /// Only the first N pairs.
    #[arg(long, value_name = "N")]
    pairs: Option<std::num::NonZeroUsize>,
    /// Leave out the families of analytic materials.
    #[arg(long)]
    no_families: bool,
    /// Folder for pictures of the ten worst pairs of each method.
    #[arg(long, value_name = "FOLDER")]
    pictures: Option<PathBuf>,
    /// What the worst pairs are worst by.
    #[arg(long, value_name = "KEY", default_value = "mix_psnr", requires = "pictures",
        value_parser = ["mix_psnr", "mix_ssim", "mix_rmse", "length_ratio", "step_ratio", "hue_excursion"])]
    worst_by: String,
}

/// The figures of one pair.
struct Measured {
    pair: String,
    figures: BTreeMap<&'static str, f64>,
}

impl Compare {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let catalog = Catalog::for_measuring(self.reference.as_deref(), self.checkpoint.as_deref())?;
        let reference = catalog.reference();
        let names: Vec<&str> = match self.methods.as_slice() {
            [] => INTERPOLATIONS.iter().map(|entry| entry.name).collect(),
            chosen => chosen.iter().map(String::as_str).collect(),
        };
        let methods = names.iter().map(|name| catalog.interpolation(name)).collect::<Result<Vec<_>>>()?;
        catalog.check_used()?;
        let pairs = self.pairs(reference)?;
        if let Some(folder) = &self.pictures {
            output::make_folder(folder)?;
        }
        let families: Vec<FittedFamily> = match self.no_families {
            true => Vec::new(),
            false => fitted_families(global)?,
        };
        let bar = progress::bar((pairs.len() * methods.len()) as u64, "comparing", global.quiet);
        let mut rows = Vec::new();
        for method in &methods {
            bar.set_message(method.name());
            let one = |ends: &[Material; 2]| {
                progress::check()?;
                let figures = path_quality(method.as_ref(), ends)?;
                bar.inc(1);
                Ok(Measured { pair: format!("{} > {}", ends[0].name, ends[1].name), figures })
            };
            let measured = pairs.par_iter().map(one).collect::<Result<Vec<_>>>()?;
            if let Some(folder) = &self.pictures {
                let title = Catalog::interpolation_entry(method.name())?.title;
                worst::draw(folder, method.as_ref(), title, &pairs, &measured, &self.worst_by)?;
            }
            rows.push(row(method.as_ref(), &measured, &families)?);
        }
        bar.finish_and_clear();
        let shown = rows.clone();
        let out = json!({"schema": 1, "reference": reference.kind, "pairs": pairs.len(), "methods": rows});
        report::print(global, &out, || text::text(&reference.kind, pairs.len(), &shown))
    }

    fn pairs(&self, reference: &Reference) -> Result<Vec<[Material; 2]>> {
        let is_merl = |material: &&Material| Database::of(&material.name) == Database::Merl;
        let mut merl: Vec<&Material> = reference.materials.iter().filter(is_merl).collect();
        merl.sort_by(|a, b| a.name.cmp(&b.name));
        let mut pairs = standard_pairs(merl.len()).peekable();
        if pairs.peek().is_none() {
            return Err(reference.lacks("MERL materials enough to pair each with another", merl.len()));
        }
        let pair = |(a, b): (usize, usize)| [merl[a].clone(), merl[b].clone()];
        Ok(pairs.take(self.pairs.map_or(usize::MAX, std::num::NonZeroUsize::get)).map(pair).collect())
    }
}

fn fitted_families(global: &Global) -> Result<Vec<FittedFamily>> {
    let all = FittedFamily::all();
    let bar = progress::bar(all.len() as u64, "families", global.quiet);
    let one = |pair| {
        let fitted = FittedFamily::fit(pair, global.seed(), &progress::cancelled);
        progress::check()?;
        let (family, lobe): (&Family, &FamilyLobe) = pair;
        let fitted = fitted.with_context(|| format!("family {} of {}: no network fits", family.name, lobe.name))?;
        bar.inc(1);
        Ok(fitted)
    };
    let fitted = all.into_par_iter().map(one).collect();
    bar.finish_and_clear();
    fitted
}

fn row(method: &dyn Interpolation, measured: &[Measured], families: &[FittedFamily]) -> Result<Value> {
    let mut row = Map::new();
    row.insert("name".into(), method.name().into());
    let keys: Vec<&str> = measured.first().map(|first| first.figures.keys().copied().collect()).unwrap_or_default();
    for key in keys {
        let values = || measured.iter().map(|one| (one.pair.as_str(), one.figures[key]));
        row.insert(key.into(), json!(Spread::new(values(), higher_is_better(key))));
        if let Some(suffix) = key.strip_prefix("albedo_max") {
            let violations = values().filter(|(_, albedo)| albedo.is_nan() || *albedo > 1.0).count();
            row.insert(format!("energy_violations{suffix}"), violations.into());
        }
    }
    let family = |fitted: &FittedFamily| {
        let error = fitted.middle_error(method)?;
        Ok(json!({
            "family": fitted.family.name, "lobe": fitted.lobe.name, "trained": fitted.lobe.trained,
            "middle": error.truth, "best": error.best,
        }))
    };
    if !families.is_empty() {
        row.insert("families".into(), families.par_iter().map(family).collect::<Result<Vec<Value>>>()?.into());
    }
    Ok(Value::Object(row))
}
