//! The methods that fit lists of samples.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::fit::{FitOptions, fit_list};
use nbrdf_core::representation::analytic::{AbcLobe, Analytic, GgxLobe, Parametric, SgdLobes, WardLobe};
use nbrdf_core::representation::linear_combination::{Coefficients, Domain};
use nbrdf_core::representation::log_table;
use nbrdf_core::representation::measured_tables::{MeasuredTables, random_cells};
use nbrdf_core::stress::samples::Sampled;
use nbrdf_core::{Brdf, Directions, Nbrdf, Warning};

use super::Setup;
use super::data::Fitted;
use crate::measure::guard;

/// A method that fits lists.
pub(super) enum ListFitter {
    /// A network, from this start.
    Network(&'static Nbrdf),
    /// A formula.
    Formula(fn(&nbrdf_core::sample_list::SampleList) -> Option<Fitted>),
    /// A sum of measured materials.
    Combination(Arc<MeasuredTables>),
}

/// The method of a representation's name, where there is one.
pub(super) fn fitter(name: &str, setup: &Setup) -> Result<Option<ListFitter>> {
    Ok(match name {
        "nbrdf" => builtin::shared().shared_start().map(ListFitter::Network),
        "lambert_ward" => Some(formula::<WardLobe>()),
        "lambert_ggx" => Some(formula::<GgxLobe>()),
        "abc" => Some(formula::<AbcLobe>()),
        "sgd" => Some(formula::<SgdLobes>()),
        "linear_combination" => Some(ListFitter::Combination(setup.catalog.measured_tables()?)),
        _ => None,
    })
}

fn formula<P: Parametric>() -> ListFitter {
    ListFitter::Formula(|list| Analytic::<P>::fit_list(list).map(Arc::from))
}

impl ListFitter {
    /// Fits samples of a material.
    pub fn fit(&self, list: &Sampled, brdf: &dyn Brdf, seed: u64) -> Result<(Fitted, Option<Warning>), String> {
        let fitted: Option<Fitted> = match self {
            Self::Network(start) => {
                let fitted = fit_list(start, &list.of(brdf, seed), FitOptions::default(), &|| false).ok_or("no fit")?;
                return Ok((Arc::new(fitted), guard::of_samples(list.count, start.weights().len())));
            }
            Self::Formula(fit) => fit(&list.of(brdf, seed)),
            Self::Combination(tables) => return combination(tables, list, brdf, seed),
        };
        Ok((fitted.ok_or("no fit")?, None))
    }
}

/// Coefficients from samples at random cells.
fn combination(
    tables: &Arc<MeasuredTables>,
    list: &Sampled,
    brdf: &dyn Brdf,
    seed: u64,
) -> Result<(Fitted, Option<Warning>), String> {
    let cells = random_cells(list.count, seed);
    let at: Vec<Directions> = cells.iter().map(|&cell| log_table::cells()[cell]).collect();
    let values = list.values(brdf, &at, seed);
    let stored: Vec<_> = at.iter().zip(values).map(|(&at, f)| log_table::stored(at, f)).collect();
    let coefficients = Coefficients::new(Arc::clone(tables), Domain::Logarithm, cells);
    let coefficients = coefficients.map_err(|error| error.to_string())?;
    let solved = coefficients.solve(&coefficients.slopes(&stored), Domain::Logarithm.damping());
    let warning = guard::of_condition(coefficients.condition(), list.count);
    Ok((Arc::new(tables.combine(&solved)), warning))
}
