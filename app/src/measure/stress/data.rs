//! Fits to measurements that are not what they should be: damaged tables for all representations, lists of samples for
//! the methods that read lists.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::brdf::table::{Lookup, Table};
use nbrdf_core::metric::{LogError, Metric};
use nbrdf_core::stress::Hazard;
use nbrdf_core::stress::damage::{DAMAGES, Damage};
use nbrdf_core::stress::numbers::Scaled;
use nbrdf_core::stress::samples::LISTS;
use nbrdf_core::{Brdf, Material, Representation, Warning};
use rayon::prelude::*;

use super::lists;
use super::picture::View;
use super::returned::Returned;
use super::tally::{Look, Tally, worse_by};
use super::{Cell, Setup};
use crate::measure::guard;

pub(super) type Fitted = Arc<dyn Brdf>;

/// A material that was measured well, and what a method makes of it.
struct Clean {
    material: Material,
    fitted: Fitted,
    error: f64,
}

/// Cells of all representations and of the methods that fit lists.
pub(super) fn cells(setup: &Setup, done: &(dyn Fn(&str) -> Result<()> + Sync)) -> Result<Vec<Cell>> {
    let materials = setup.held_out(setup.extent.few)?;
    let mut cells = Vec::new();
    for entry in setup.representations() {
        done(entry.name)?;
        let representation = entry.build(setup.catalog)?;
        let clean: Vec<_> = materials.par_iter().map(|material| clean(representation.as_ref(), material)).collect();
        let tables = DAMAGES.iter().filter(|damage| setup.wants(&damage.hazard));
        let cell = |damage: &Damage| {
            let again = |own: &Clean| of_table(setup, representation.as_ref(), damage, own);
            cell(&damage.hazard, &clean, &again).cell(entry.name, entry.shown_variant())
        };
        cells.extend(tables.filter_map(cell));
        let Some(fitter) = lists::fitter(entry.name, setup)? else { continue };
        for list in LISTS.iter().filter(|list| setup.wants(&list.hazard)) {
            let again = |own: &Clean| {
                let (fitted, more) = fitter.fit(list, own.material.brdf.as_ref(), setup.seed)?;
                let warnings = more.into_iter().chain(guard::of_reflectance(fitted.as_ref())).collect();
                Ok((added(own, fitted.as_ref()), [Arc::clone(&own.fitted), fitted], warnings))
            };
            cells.extend(self::cell(&list.hazard, &clean, &again).cell(entry.name, entry.shown_variant()));
        }
    }
    Ok(cells)
}

/// What a fit to bad measurements is: how bad, what should be, the fit itself, and what is said of it.
type Bad = Result<(f64, [Fitted; 2], Vec<Warning>), String>;

fn cell<'a>(hazard: &'a Hazard, clean: &[Measured], again: &(dyn Fn(&Clean) -> Bad + Sync)) -> Tally<'a> {
    let mut tally = Tally::new(hazard);
    let fits: Vec<Bad> = clean.par_iter().map(|(_, own)| own.as_ref().map_err(String::clone).and_then(again)).collect();
    for ((name, own), fit) in clean.iter().zip(fits) {
        match (own, fit) {
            (Ok(_), Ok((value, [wanted, fitted], warnings))) => tally.add(name, value, || {
                let panels = vec![(name.clone(), wanted), ("damaged".to_owned(), fitted)];
                (Look { panels, view: View::Studio }, warnings)
            }),
            (Err(error), _) => tally.refuse(name, error),
            (_, Err(error)) => tally.refuse(name, &error),
        }
    }
    tally
}

/// The name of a material, and what a method makes of it; or why it makes nothing of a table.
type Measured = (String, Result<Clean, String>);

/// From a table without damage, read as any measured one.
fn clean(representation: &dyn Representation, material: &Material) -> Measured {
    let fit = || -> Result<Clean, String> {
        let table = Table::tabulate(material.brdf.as_ref(), Lookup::Trilinear);
        let measured = Material::new(&material.name, Arc::new(table));
        let fitted = Returned::by(representation, &measured)?.brdf;
        let error = LogError.distance(material.brdf.as_ref(), fitted.as_ref());
        Ok(Clean { material: material.clone(), fitted, error })
    };
    (material.name.clone(), fit())
}

/// From a damaged one.
fn of_table(setup: &Setup, representation: &dyn Representation, damage: &Damage, own: &Clean) -> Bad {
    let table: Fitted = Arc::new(damage.measured(own.material.brdf.as_ref(), setup.seed));
    let measured = Material::new(&own.material.name, table);
    let returned = Returned::by(representation, &measured)?;
    let warnings = returned.warnings(&measured, &setup.known())?;
    let fitted = returned.brdf;
    let (value, wanted): (f64, Fitted) = match damage.scale {
        Some(scale) => {
            let wanted = Scaled { inner: Arc::clone(&own.fitted), scale };
            (LogError.distance(&wanted, fitted.as_ref()), Arc::new(wanted))
        }
        None => (added(own, fitted.as_ref()), Arc::clone(&own.fitted)),
    };
    Ok((value, [wanted, fitted], warnings))
}

/// How much further from the truth than with clean measurements.
fn added(own: &Clean, fitted: &dyn Brdf) -> f64 {
    worse_by(LogError.distance(own.material.brdf.as_ref(), fitted) - own.error)
}
