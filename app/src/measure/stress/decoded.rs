//! Decoded materials where they are hard to know, and against what nature allows.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{albedo_max, negative_share, reciprocity};
use nbrdf_core::quality::Qualities;
use nbrdf_core::stress::directions::EXPOSURES;
use nbrdf_core::stress::{Group, Hazard};
use nbrdf_core::{Brdf, Material, Warning};
use rayon::prelude::*;

use super::picture::View;
use super::returned::Returned;
use super::tally::{Look, Tally};
use super::{Cell, Setup};
use crate::measure::guard;

/// Materials in the work at once: tables are large.
const AT_ONCE: usize = 4;
/// Share of the materials that count as glossy.
const GLOSSY: f64 = 0.25;

/// What nature allows.
pub(super) const PHYSICS: [Hazard; 3] = [
    Hazard {
        name: "reciprocity",
        group: Group::Physics,
        title: "Light and view exchanged must give the same",
        measure: "mean |f(i, o) − f(o, i)| / mean f",
        holds: 0.05,
        fails: 0.2,
    },
    Hazard {
        name: "energy",
        group: Group::Physics,
        title: "No more light may leave than arrives: the white furnace",
        measure: "largest albedo",
        holds: 1.0,
        fails: 1.05,
    },
    Hazard {
        name: "negative",
        group: Group::Physics,
        title: "Reflectance below zero, before it is clamped",
        measure: "share of directions",
        holds: 0.001,
        fails: 0.05,
    },
];

/// A material as a method gives it back, and what the library says of it.
struct Shown {
    name: String,
    reference: Arc<dyn Brdf>,
    model: Arc<dyn Brdf>,
    warnings: Vec<Warning>,
    /// One for each hazard; none where the material is not exposed to it.
    values: Vec<Option<f64>>,
}

/// Of a reference and a model.
type Value = Box<dyn Fn(&dyn Brdf, &dyn Brdf) -> f64 + Sync>;

/// A hazard of this file.
struct Asked {
    hazard: &'static Hazard,
    view: View,
    only_glossy: bool,
    value: Value,
    said: Option<fn(&dyn Brdf) -> Option<Warning>>,
}

fn asked(setup: &Setup, group: Group) -> Vec<Asked> {
    let exposures = EXPOSURES.iter().map(|exposure| Asked {
        hazard: &exposure.hazard,
        view: if exposure.hazard.name.starts_with("grazing") { View::Rim } else { View::Studio },
        only_glossy: exposure.only_glossy,
        value: Box::new(exposure.value),
        said: exposure.said,
    });
    let figures: [fn(&dyn Brdf) -> f64; 3] = [reciprocity, albedo_max, negative_share];
    let physics = PHYSICS.iter().zip(figures).map(|(hazard, figure)| Asked {
        hazard,
        view: View::Studio,
        only_glossy: false,
        value: Box::new(move |_, model| figure(model)),
        said: None,
    });
    exposures.chain(physics).filter(|asked| asked.hazard.group == group && setup.wants(asked.hazard)).collect()
}

/// Cells of all representations, and of the reference itself.
pub(super) fn cells(setup: &Setup, group: Group, done: &(dyn Fn(&str) -> Result<()> + Sync)) -> Result<Vec<Cell>> {
    let asked = asked(setup, group);
    let materials = setup.held_out(setup.extent.materials)?;
    let glossy = glossy(&materials);
    let mut cells = Vec::new();
    if setup.wants_method(REFERENCE) {
        done(REFERENCE)?;
        // As they are stored: all of them.
        let all = if group == Group::Physics { &setup.catalog.reference().materials } else { &materials };
        let own = |material: &Material| {
            let warnings = guard::of_reflectance(material.brdf.as_ref());
            Ok((Arc::clone(&material.brdf), warnings))
        };
        cells.extend(of_method((REFERENCE, None), &asked, (all, &self::glossy(all)), &own));
    }
    let known = setup.known();
    for entry in setup.representations() {
        done(entry.name)?;
        let representation = entry.build(setup.catalog)?;
        let again = |material: &Material| {
            let returned = Returned::by(representation.as_ref(), material)?;
            let warnings = returned.warnings(material, &known)?;
            Ok((returned.brdf, warnings))
        };
        cells.extend(of_method((entry.name, entry.shown_variant()), &asked, (&materials, &glossy), &again));
    }
    Ok(cells)
}

/// Name of what is stored itself, in reports.
pub(super) const REFERENCE: &str = "reference";

/// A material as a method gives it back, or why not.
type Again<'a> = &'a (dyn Fn(&Material) -> Result<(Arc<dyn Brdf>, Vec<Warning>), String> + Sync);

fn of_method(
    (name, variant): (&str, Option<&str>),
    asked: &[Asked],
    (materials, glossy): (&[Material], &[bool]),
    again: Again,
) -> Vec<Cell> {
    let mut tallies: Vec<Tally> = asked.iter().map(|asked| Tally::new(asked.hazard)).collect();
    let exposed: Vec<(&Material, bool)> = materials.iter().zip(glossy.iter().copied()).collect();
    for some in exposed.chunks(AT_ONCE) {
        let one = |&(material, is_glossy): &(&Material, bool)| -> Result<Shown, String> {
            let (model, warnings) = again(material)?;
            let value = |asked: &Asked| {
                let is_exposed = is_glossy || !asked.only_glossy;
                is_exposed.then(|| (asked.value)(material.brdf.as_ref(), model.as_ref()))
            };
            let values = asked.iter().map(value).collect();
            let (name, reference) = (material.name.clone(), Arc::clone(&material.brdf));
            Ok(Shown { name, reference, model, warnings, values })
        };
        let shown: Vec<Result<Shown, String>> = some.par_iter().map(one).collect();
        for (result, (material, _)) in shown.into_iter().zip(some) {
            for (index, (tally, asked)) in tallies.iter_mut().zip(asked).enumerate() {
                match &result {
                    Ok(shown) => shown.add(tally, index, asked),
                    Err(refused) => tally.refuse(&material.name, refused),
                }
            }
        }
    }
    tallies.into_iter().filter_map(|tally| tally.cell(name, variant)).collect()
}

impl Shown {
    fn add(&self, tally: &mut Tally, index: usize, asked: &Asked) {
        let Some(value) = self.values[index] else { return };
        let look = || {
            let panels =
                vec![(self.name.clone(), Arc::clone(&self.reference)), ("decoded".to_owned(), Arc::clone(&self.model))];
            let said = asked.said.and_then(|said| said(self.model.as_ref()));
            (Look { panels, view: asked.view }, self.warnings.iter().cloned().chain(said).collect())
        };
        tally.add(&self.name, value, look);
    }
}

/// Which of these are glossy, against the others.
fn glossy(materials: &[Material]) -> Vec<bool> {
    let gloss: Vec<f64> = materials.iter().map(|material| Qualities::of(material.brdf.as_ref()).gloss).collect();
    let mut sorted = gloss.clone();
    sorted.sort_by(|a, b| b.total_cmp(a));
    let last = sorted[((GLOSSY * sorted.len() as f64).ceil() as usize).clamp(1, sorted.len()) - 1];
    gloss.into_iter().map(|own| own >= last).collect()
}
