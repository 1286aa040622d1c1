//! Codes and weights out of the ordinary.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{LogError, Metric, RelativeLog};
use nbrdf_core::nbrdf::PUBLISHED_WEIGHTS;
use nbrdf_core::stress::Hazard;
use nbrdf_core::stress::numbers::{
    BRIGHTNESS, CONSTANT, DENORMAL, FAR, FAR_CODES, RETOLD, Retold, Scaled, constants, unsound_share,
};
use nbrdf_core::{Brdf, Code, Material, Nbrdf, Representation, Rgb, Warning};
use rayon::prelude::*;

use super::picture::View;
use super::returned::Returned;
use super::tally::{Look, Tally, worse_by};
use super::{Cell, Setup};
use crate::catalog::RepresentationEntry;
use crate::measure::guard;

/// Cells of all representations.
pub(super) fn cells(setup: &Setup, done: &(dyn Fn(&str) -> Result<()> + Sync)) -> Result<Vec<Cell>> {
    let materials = setup.held_out(setup.extent.few)?;
    let mut cells = Vec::new();
    for entry in setup.representations() {
        done(entry.name)?;
        let representation = entry.build(setup.catalog)?;
        let tried = Tried { setup, entry, representation: representation.as_ref(), materials: &materials };
        cells.extend(tried.retold().into_iter().chain(tried.bright()).chain(tried.constant()));
        cells.extend(tried.denormal().into_iter().chain(tried.far()));
    }
    Ok(cells)
}

/// A representation under test.
struct Tried<'a> {
    setup: &'a Setup<'a>,
    entry: &'static RepresentationEntry,
    representation: &'a dyn Representation,
    materials: &'a [Material],
}

/// How bad, what was found, and what is said of it.
type Judged = Result<(f64, Arc<dyn Brdf>, Vec<Warning>), String>;

/// What became of a material: what should be, what is, and what is said of it.
struct Outcome {
    name: String,
    wanted: Arc<dyn Brdf>,
    result: Judged,
}

impl Tried<'_> {
    fn cell(&self, hazard: &Hazard, outcomes: Vec<Outcome>) -> Option<Cell> {
        let mut tally = Tally::new(hazard);
        for Outcome { name, wanted, result } in outcomes {
            match result {
                Ok((value, found, warnings)) => tally.add(&name, value, || {
                    let panels = vec![(name.clone(), wanted), ("found".to_owned(), found)];
                    (Look { panels, view: View::Studio }, warnings)
                }),
                Err(error) => tally.refuse(&name, &error),
            }
        }
        tally.cell(self.entry.name, self.entry.shown_variant())
    }

    /// Encoded and decoded, with what is said of it.
    fn again(&self, material: &Material) -> Result<(Arc<dyn Brdf>, Vec<Warning>), String> {
        let returned = Returned::by(self.representation, material)?;
        let warnings = returned.warnings(material, &self.setup.known())?;
        Ok((returned.brdf, warnings))
    }

    /// The same materials told by other weights: how much worse these are encoded than the usual ones.
    fn retold(&self) -> Vec<Cell> {
        let asked: Vec<&Retold> = RETOLD.iter().filter(|retold| self.setup.wants(&retold.hazard)).collect();
        if asked.is_empty() {
            return Vec::new();
        }
        let error = |material: &Material, found: &dyn Brdf| LogError.distance(material.brdf.as_ref(), found);
        let usual = |material: &Material| {
            let returned = Returned::by(self.representation, material)?;
            Ok(error(material, returned.brdf.as_ref()))
        };
        let usual: Vec<Result<f64, String>> = self.materials.par_iter().map(usual).collect();
        let cell = |retold: &Retold| {
            let one = |(material, usual): (&Material, &Result<f64, String>)| {
                let own = material.network.as_ref()?;
                let other = Material::from_network(&material.name, (retold.network)(own, self.setup.seed));
                let result = usual.clone().and_then(|usual| {
                    let (found, warnings) = self.again(&other)?;
                    Ok((worse_by(error(&other, found.as_ref()) - usual), found, warnings))
                });
                Some(Outcome { name: material.name.clone(), wanted: other.brdf, result })
            };
            self.cell(&retold.hazard, self.materials.par_iter().zip(&usual).filter_map(one).collect())
        };
        asked.into_iter().filter_map(cell).collect()
    }

    /// Materials of other brightness: against themselves, brightness undone.
    fn bright(&self) -> Vec<Cell> {
        let scaled = |brdf: &Arc<dyn Brdf>, scale: f32| -> Arc<dyn Brdf> {
            Arc::new(Scaled { inner: Arc::clone(brdf), scale: Rgb::splat(scale) })
        };
        let cell = |hazard: &Hazard, factor: f32| {
            let one = |material: &Material| {
                let other = Material::new(&material.name, scaled(&material.brdf, factor));
                let result = self.again(&other).map(|(found, warnings)| {
                    let found = scaled(&found, 1.0 / factor);
                    (RelativeLog.distance(material.brdf.as_ref(), found.as_ref()), found, warnings)
                });
                Outcome { name: material.name.clone(), wanted: Arc::clone(&material.brdf), result }
            };
            self.cell(hazard, self.materials.par_iter().map(one).collect())
        };
        let asked = BRIGHTNESS.iter().filter(|(hazard, _)| self.setup.wants(hazard));
        asked.filter_map(|(hazard, factor)| cell(hazard, *factor)).collect()
    }

    fn constant(&self) -> Option<Cell> {
        let one = |(name, brdf): (&'static str, nbrdf_core::brdf::lambert::Lambert)| {
            let mut weights = vec![0.0; PUBLISHED_WEIGHTS];
            let f = brdf.albedo.map(|albedo| (albedo / std::f32::consts::PI).ln_1p());
            weights[PUBLISHED_WEIGHTS - 3..].copy_from_slice(&f.0);
            let network = Nbrdf::published(weights).map_err(|error| error.to_string());
            let result = network.and_then(|network| {
                let (found, warnings) = self.again(&Material::from_network(name, network))?;
                Ok((LogError.distance(&brdf, found.as_ref()), found, warnings))
            });
            Outcome { name: name.to_owned(), wanted: Arc::new(brdf), result }
        };
        let asked = self.setup.wants(&CONSTANT);
        asked.then(|| self.cell(&CONSTANT, constants().into_par_iter().map(one).collect())).flatten()
    }

    fn denormal(&self) -> Option<Cell> {
        let one = |material: &Material| {
            let inner = Arc::clone(&material.brdf);
            let wanted: Arc<dyn Brdf> = Arc::new(Scaled { inner, scale: Rgb::splat(1e-40) });
            let other = Material::new(&material.name, Arc::clone(&wanted));
            let result = self.again(&other).map(|(found, warnings)| (unsound_share(found.as_ref()), found, warnings));
            Outcome { name: material.name.clone(), wanted, result }
        };
        let asked = self.setup.wants(&DENORMAL);
        asked.then(|| self.cell(&DENORMAL, self.materials.par_iter().map(one).collect())).flatten()
    }

    /// Codes far from any material's.
    fn far(&self) -> Option<Cell> {
        let one = |material: &Material| -> Vec<Outcome> {
            let outcome = |name: String, result| Outcome { name, wanted: Arc::clone(&material.brdf), result };
            let code = match self.representation.encode(material) {
                Ok(code) => code,
                Err(error) => return vec![outcome(material.name.clone(), Err(error.to_string()))],
            };
            let times = FAR_CODES.into_iter().map(|factor| {
                // Infinity stands for the largest numbers there are, signs kept.
                let far = |v: &f32| (v * factor).clamp(-f32::MAX, f32::MAX);
                (format!("{} × {factor:e}", material.name), code.code.iter().map(far).map(nan_to_zero).collect())
            });
            let zeros = [(format!("{} × 0", material.name), vec![0.0; code.code.len()])];
            let judged = |(name, numbers): (String, Vec<f32>)| outcome(name, self.judged(numbers));
            times.chain(zeros).map(judged).collect()
        };
        let asked = self.setup.wants(&FAR);
        asked.then(|| self.cell(&FAR, self.materials.par_iter().flat_map(one).collect())).flatten()
    }

    fn judged(&self, numbers: Vec<f32>) -> Judged {
        let code: Code = self.representation.code(numbers);
        let found = self.representation.decode(&code).map_err(|error| error.to_string())?;
        let known = self.setup.known();
        let far = guard::of_distance(&code, &known).map_err(|error| error.to_string())?;
        let warnings = far.into_iter().chain(guard::of_reflectance(found.as_ref())).collect();
        Ok((unsound_share(found.as_ref()), Arc::from(found), warnings))
    }
}

/// 0 times infinity is no code.
fn nan_to_zero(v: f32) -> f32 {
    if v.is_nan() { 0.0 } else { v }
}
