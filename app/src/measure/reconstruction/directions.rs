//! A few directions, chosen by either criterion or at random.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::representation::log_table::cells;
use nbrdf_core::representation::measured_tables::{measure, random_cells};
use nbrdf_core::representation::optimal_sampling::design::{Criterion, condition};
use nbrdf_core::representation::optimal_sampling::directions::choose;
use nbrdf_core::representation::optimal_sampling::log_relative::{LogRelative, SeenComponents};
use nbrdf_core::representation::optimal_sampling::{DAMPING, PUBLISHED_DAMPING, Reconstruction};
use rayon::prelude::*;
use serde::Serialize;

use super::{Draws, Errors, Targets};

/// Numbers of directions, those of the paper.
pub const COUNTS: [usize; 5] = [1, 2, 5, 10, 20];

/// One way to choose so many directions.
#[derive(Debug, Serialize)]
pub struct DirectionsRow {
    /// How many.
    pub count: usize,
    /// `random`, `condition_number`, or `expected_error`.
    pub chosen_by: &'static str,
    /// η of the ridge.
    pub damping: f64,
    /// Condition number of the measured rows in as many components.
    pub condition: Draws,
    /// Mean over materials.
    pub log_error: Draws,
    /// Mean over materials.
    pub relative_log: Draws,
    /// Materials that come closer in `log_error` than from random directions, on their mean over draws.
    pub log_error_wins: usize,
    /// The same in `relative_log`.
    pub relative_log_wins: usize,
    /// θ_half, θ_diff, φ_diff \[degrees\] of chosen directions; none where they are drawn.
    pub directions: Vec<[f32; 3]>,
}

/// Condition number, and the errors of every material.
type Measured = (f64, Vec<Errors>);

/// How many times `done` is called.
pub const fn steps(draws: u64) -> u64 {
    COUNTS.len() as u64 * (draws + 3)
}

/// All rows; `done` is called after each set of directions and may end the work.
pub fn directions(
    targets: &Targets,
    basis: &Arc<LogRelative>,
    seen: &SeenComponents,
    seed: u64,
    draws: u64,
    done: &dyn Fn() -> Result<()>,
) -> Result<Vec<DirectionsRow>> {
    let measured = |cells: &[usize], damping: f64| -> Result<Measured> {
        let reconstruction = Reconstruction::new(Arc::clone(basis), cells.to_vec(), damping);
        let one = |(number, material): (usize, &&nbrdf_core::Material)| {
            let values = measure(material.brdf.as_ref(), cells);
            targets.errors(number, &basis.predict(seen, &reconstruction.coefficients(&values)))
        };
        let errors = targets.materials.par_iter().enumerate().map(one).collect();
        done()?;
        Ok((condition(&basis.matrix(cells)), errors))
    };
    let expected = Criterion::expected_error(basis, DAMPING);
    let mut rows = Vec::new();
    for count in COUNTS {
        let draw = |draw: u64| measured(&random_cells(count, seed.wrapping_add(draw)), DAMPING);
        let random = (0..draws).map(draw).collect::<Result<Vec<Measured>>>()?;
        let beside = |number: usize| Errors::mean(&random.iter().map(|(_, errors)| errors[number]).collect::<Vec<_>>());
        let beside: Vec<Errors> = (0..targets.materials.len()).map(beside).collect();
        let mut add = |chosen_by: &'static str, damping: f64, cells: &[usize], all: &[Measured]| {
            let mean = |(_, errors): &Measured| Errors::mean(errors);
            let wins = |value: fn(&Errors) -> f64| {
                let won = |(own, random): (&Errors, &Errors)| value(own) < value(random);
                all.first().map_or(0, |(_, own)| own.iter().zip(&beside).filter(|pair| won(*pair)).count())
            };
            let is_chosen = !cells.is_empty();
            rows.push(DirectionsRow {
                count,
                chosen_by,
                damping,
                condition: Draws::of(all.iter().map(|(condition, _)| *condition)),
                log_error: Draws::of(all.iter().map(|all| mean(all).log_error)),
                relative_log: Draws::of(all.iter().map(|all| mean(all).relative_log)),
                log_error_wins: if is_chosen { wins(|errors| errors.log_error) } else { 0 },
                relative_log_wins: if is_chosen { wins(|errors| errors.relative_log) } else { 0 },
                directions: angles(cells),
            });
        };
        add("random", DAMPING, &[], &random);
        let by_condition = choose(basis, count, &Criterion::ConditionNumber, &expected);
        for damping in [PUBLISHED_DAMPING, DAMPING] {
            add("condition_number", damping, &by_condition, &[measured(&by_condition, damping)?]);
        }
        let by_error = choose(basis, count, &expected, &expected);
        add("expected_error", DAMPING, &by_error, &[measured(&by_error, DAMPING)?]);
    }
    Ok(rows)
}

/// Angles of cells \[degrees\], to a tenth.
fn angles(chosen: &[usize]) -> Vec<[f32; 3]> {
    let degrees = |radians: f32| (radians.to_degrees() * 10.0).round() / 10.0;
    let one = |&cell: &usize| {
        let angles = cells()[cell].rusinkiewicz();
        [angles.theta_half, angles.theta_diff, angles.phi_diff].map(degrees)
    };
    chosen.iter().map(one).collect()
}
