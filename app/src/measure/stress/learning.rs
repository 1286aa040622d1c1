//! What learned methods owe to what they were taught: fewer materials, missing classes, wrong ones, other seeds.
//!
//! ZNBRDF is trained anew for each, with fewer steps than the built-in checkpoint; all its trainings have the same.

mod student;
mod syllabus;

use std::collections::BTreeMap;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{LogError, Metric};
use nbrdf_core::stress::{Group, Hazard, Verdict};
use nbrdf_core::{Database, Material, Representation, Split, Warning};
use rayon::prelude::*;

use super::picture::View;
use super::returned::Returned;
use super::tally::{Look, Tally, worse_by};
use super::{Cell, Setup};
use student::{STUDENTS, Student};
use syllabus::{SYLLABI, Syllabus};

/// Seeds of the trainings that are compared.
const SEEDS: u64 = 5;

/// The first that follow are taught less than all, by [`SYLLABI`].
pub(super) const HAZARDS: [Hazard; 7] = [
    hazard("trained_40", "Half the training materials"),
    hazard("trained_20", "A quarter of the training materials"),
    hazard("no_metals", "No metals among the training materials, and then metals"),
    hazard("no_fabrics", "No fabrics among the training materials, and then fabrics"),
    hazard("wrong_scales", "A tenth of the training materials without the scales of green and blue"),
    Hazard {
        measure: "log_error of a material, less the mean of held-out MERL materials",
        ..hazard("other_database", "Materials of another database (held-out RGL)")
    },
    Hazard {
        measure: "log_error of a material, worst less best seed",
        ..hazard("seeds", "Five seeds of everything random in learning")
    },
];

const fn hazard(name: &'static str, title: &'static str) -> Hazard {
    Hazard {
        name,
        group: Group::Learning,
        title,
        measure: "log_error of a held-out material, less that of who has learned from all 80",
        holds: 0.002,
        fails: 0.01,
    }
}

/// A method that has learned, and its errors by material.
struct Taught {
    representation: Arc<dyn Representation>,
    errors: BTreeMap<String, Result<f64, String>>,
}

/// Cells of all that learn.
pub(super) fn cells(setup: &Setup, done: &(dyn Fn(&str) -> Result<()> + Sync)) -> Result<Vec<Cell>> {
    let all = setup.catalog.training_materials();
    let held_out = setup.held_out(setup.extent.materials)?;
    let others: Vec<Material> =
        setup.catalog.reference().of(Database::Rgl, Split::HeldOut).into_iter().cloned().collect();
    let mut cells = Vec::new();
    for student in STUDENTS.iter().filter(|student| setup.wants_method(student.name)) {
        let lesson = Lesson { setup, student, held_out: &held_out };
        let teach = |materials: &[Material], seed: u64| -> Result<Result<Taught, String>> {
            done(student.name)?;
            Ok(student.learn(setup, materials, seed, done)?.map(|learned| lesson.examined(learned)))
        };
        let best = match teach(&all, setup.seed)? {
            Ok(best) => best,
            Err(refusal) => {
                let asked = HAZARDS.iter().filter(|hazard| setup.wants(hazard));
                cells.extend(asked.filter_map(|hazard| lesson.refused(hazard, &refusal)));
                continue;
            }
        };
        for (syllabus, hazard) in SYLLABI.iter().zip(&HAZARDS).filter(|(_, hazard)| setup.wants(hazard)) {
            cells.extend(match teach(&syllabus.materials(&all), setup.seed)? {
                Ok(taught) => lesson.less(hazard, syllabus, &best, &taught),
                Err(refusal) => lesson.refused(hazard, &refusal),
            });
        }
        let [.., other, seeds] = &HAZARDS;
        if setup.wants(other) {
            cells.extend(lesson.elsewhere(other, &best, &others));
        }
        if student.is_random && setup.wants(seeds) {
            let more = (1..SEEDS).map(|seed| teach(&all, setup.seed.wrapping_add(seed)));
            let more: Vec<Taught> = more.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
            cells.extend(lesson.spread(seeds, &best, &more));
        }
    }
    Ok(cells)
}

/// A student, and what he is examined in.
struct Lesson<'a> {
    setup: &'a Setup<'a>,
    student: &'static Student,
    held_out: &'a [Material],
}

impl Lesson<'_> {
    fn examined(&self, representation: Arc<dyn Representation>) -> Taught {
        let error = |material: &Material| {
            let returned = Returned::by(representation.as_ref(), material);
            let error = returned.map(|found| LogError.distance(material.brdf.as_ref(), found.brdf.as_ref()));
            (material.name.clone(), error)
        };
        let errors = self.held_out.par_iter().map(error).collect();
        Taught { representation, errors }
    }

    /// Against who was taught all.
    fn less(&self, hazard: &Hazard, syllabus: &Syllabus, best: &Taught, taught: &Taught) -> Option<Cell> {
        let value = |name: &str| Some(error(taught, name)? - error(best, name)?);
        let examined = self.held_out.iter().filter(|material| syllabus.is_examined(&material.name));
        let note = format!("mean log_error {:.4}, of all {:.4}", mean(taught, syllabus), mean(best, syllabus));
        self.cell(hazard, examined, taught, value, note)
    }

    /// Too little to learn from.
    fn refused(&self, hazard: &Hazard, refusal: &str) -> Option<Cell> {
        let mut tally = Tally::new(hazard);
        tally.refuse(self.student.name, refusal);
        tally.cell(self.student.name, None)
    }

    /// Materials of another database.
    fn elsewhere(&self, hazard: &Hazard, best: &Taught, others: &[Material]) -> Option<Cell> {
        let usual = mean(best, &Syllabus::ALL);
        let abroad = Lesson { held_out: others, ..*self }.examined(Arc::clone(&best.representation));
        let value = |name: &str| Some(error(&abroad, name)? - usual);
        let note = format!("mean log_error {:.4}, of MERL {usual:.4}", mean(&abroad, &Syllabus::ALL));
        self.cell(hazard, others.iter(), &abroad, value, note)
    }

    fn spread(&self, hazard: &Hazard, first: &Taught, more: &[Taught]) -> Option<Cell> {
        let all = || std::iter::once(first).chain(more);
        let means = all().map(|taught| format!("{:.4}", mean(taught, &Syllabus::ALL)));
        let note = format!("mean log_error {}", means.collect::<Vec<_>>().join(", "));
        let value = |name: &str| {
            let errors: Option<Vec<f64>> = all().map(|taught| error(taught, name)).collect();
            // A seed without a number would vanish between the others.
            let errors = errors?;
            if !errors.iter().all(|error| error.is_finite()) {
                return Some(f64::NAN);
            }
            let (low, high) = errors.iter().fold((f64::INFINITY, 0f64), |(low, high), &e| (low.min(e), high.max(e)));
            Some(high - low)
        };
        self.cell(hazard, self.held_out.iter(), first, value, note)
    }

    fn cell<'m>(
        &self,
        hazard: &Hazard,
        materials: impl Iterator<Item = &'m Material>,
        taught: &Taught,
        value: impl Fn(&str) -> Option<f64>,
        note: String,
    ) -> Option<Cell> {
        let mut tally = Tally::new(hazard);
        for material in materials {
            let name = &material.name;
            match value(name) {
                Some(value) => tally.add(name, worse_by(value), || self.look(material, taught)),
                None => tally.refuse(name, "no code"),
            }
        }
        let cell = tally.cell(self.student.name, None)?;
        let note = if cell.verdict == Verdict::Refuses { cell.note } else { Some(note) };
        Some(Cell { note, ..cell })
    }

    fn look(&self, material: &Material, taught: &Taught) -> (Look, Vec<Warning>) {
        let own = (material.name.clone(), Arc::clone(&material.brdf));
        let mut panels = vec![own];
        let mut warnings = Vec::new();
        if let Ok(returned) = Returned::by(taught.representation.as_ref(), material) {
            // Told by those who will use it: what the trained checkpoint itself knows is another mark.
            warnings = returned.warnings(material, &self.setup.known()).unwrap_or_default();
            panels.push(("decoded".to_owned(), returned.brdf));
        }
        (Look { panels, view: View::Studio }, warnings)
    }
}

fn error(taught: &Taught, name: &str) -> Option<f64> {
    taught.errors.get(name)?.as_ref().ok().copied()
}

/// Over the materials that are examined.
fn mean(taught: &Taught, syllabus: &Syllabus) -> f64 {
    let examined = taught.errors.iter().filter(|(name, _)| syllabus.is_examined(name));
    let errors: Vec<f64> = examined.filter_map(|(_, error)| error.as_ref().ok().copied()).collect();
    errors.iter().sum::<f64>() / errors.len().max(1) as f64
}
