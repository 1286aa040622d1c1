//! Measured materials as a basis: coefficients from the whole table, and from random samples of it.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::representation::linear_combination::{Coefficients, Domain, Seen};
use nbrdf_core::representation::log_table::measurable;
use nbrdf_core::representation::measured_tables::{MeasuredTables, measure, random_cells};
use nbrdf_core::sampling::rus32k;
use rayon::prelude::*;
use serde::Serialize;

use super::{Draws, Errors, Targets};

/// Numbers of samples.
pub const COUNTS: [usize; 6] = [100, 200, 400, 800, 1600, 3200];

/// One way to find coefficients.
#[derive(Debug, Serialize)]
pub struct CombinationRow {
    /// What is added up: `logarithm`, ln(f c + 10⁻³), or `reflectance`, f c.
    pub domain: &'static str,
    /// `plain` or `ridge` least squares.
    pub solve: &'static str,
    /// Random samples, or all cells of the table.
    pub samples: usize,
    /// Whether these are all cells.
    pub whole_table: bool,
    /// Condition number of the rows.
    pub condition: Draws,
    /// Mean over materials.
    pub log_error: Draws,
    /// Mean over materials.
    pub relative_log: Draws,
    /// Mean `log_error` over that of the same solve from the whole table.
    pub log_error_ratio: f64,
    /// Mean `relative_log` over that of the same solve from the whole table.
    pub relative_log_ratio: f64,
}

/// Domains with their names in reports.
const DOMAINS: [(Domain, &str); 2] = [(Domain::Logarithm, "logarithm"), (Domain::Reflectance, "reflectance")];
/// Solves with their names in reports.
const SOLVES: [&str; 2] = ["plain", "ridge"];

/// A condition number, and the mean errors of the plain and of the ridge solve.
type Solved = (f64, [Errors; 2]);

/// How many times `done` is called.
pub const fn steps(draws: u64) -> u64 {
    DOMAINS.len() as u64 * (1 + COUNTS.len() as u64 * draws)
}

/// All rows; `done` is called after each solve of all materials and may end the work.
pub fn combination(
    targets: &Targets,
    basis: &Arc<MeasuredTables>,
    seed: u64,
    draws: u64,
    done: &(dyn Fn() -> Result<()> + Sync),
) -> Result<Vec<CombinationRow>> {
    let seen = Seen::new(basis, rus32k());
    let solved = |domain: Domain, cells: Vec<usize>| -> Result<Solved> {
        let coefficients = Coefficients::new(Arc::clone(basis), domain, cells)?;
        let one = |(number, material): (usize, &&nbrdf_core::Material)| {
            let slopes = coefficients.slopes(&measure(material.brdf.as_ref(), coefficients.cells()));
            [0.0, domain.damping()].map(|damping| {
                targets.errors(number, &coefficients.predict(&seen, &coefficients.solve(&slopes, damping)))
            })
        };
        let all: Vec<[Errors; 2]> = targets.materials.par_iter().enumerate().map(one).collect();
        done()?;
        let mean = |solve: usize| Errors::mean(&all.iter().map(|errors| errors[solve]).collect::<Vec<_>>());
        Ok((coefficients.condition(), [mean(0), mean(1)]))
    };
    let mut rows = Vec::new();
    for (domain, name) in DOMAINS {
        let whole = [solved(domain, measurable().to_vec())?];
        let mut add = |samples: usize, whole_table: bool, drawn: &[Solved]| {
            for (index, solve) in SOLVES.into_iter().enumerate() {
                let figure =
                    |value: fn(&Errors) -> f64| Draws::of(drawn.iter().map(|(_, errors)| value(&errors[index])));
                let (log_error, relative_log) = (figure(|e| e.log_error), figure(|e| e.relative_log));
                rows.push(CombinationRow {
                    domain: name,
                    solve,
                    samples,
                    whole_table,
                    condition: Draws::of(drawn.iter().map(|(condition, _)| *condition)),
                    log_error,
                    relative_log,
                    log_error_ratio: log_error.mean / whole[0].1[index].log_error,
                    relative_log_ratio: relative_log.mean / whole[0].1[index].relative_log,
                });
            }
        };
        for samples in COUNTS {
            let draw = |draw: u64| solved(domain, random_cells(samples, seed.wrapping_add(draw)));
            add(samples, false, &(0..draws).map(draw).collect::<Result<Vec<_>>>()?);
        }
        add(measurable().len(), true, &whole);
    }
    Ok(rows)
}
