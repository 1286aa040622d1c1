//! The search for directions: cells of the table, moved one at a time as long as that helps.
//!
//! J. B. Nielsen et al. (2015), descent over the cells of the table: from several starts, every direction steps to the
//! neighbouring cell that lowers the cost most, until none does. Differs: steps of one to sixteen cells along each axis,
//! so that a small dent does not hold a direction; and one start is greedy, each direction the best beside those before.

use faer::Mat;
use rayon::prelude::*;

use super::super::log_table::{CELLS, index, measurable, place};
use super::super::measured_tables::random_cells;
use super::design::{Criterion, posterior};
use super::log_relative::LogRelative;

/// Starts at random beside the greedy one.
const RANDOM_STARTS: u64 = 3;
/// The greedy start looks at each so many cells; neighbours are found by the descent.
const STRIDE: usize = 3;
/// A round that gains less than this share is the last one.
const GAIN: f64 = 1e-3;
/// Rounds at most.
const ROUNDS: usize = 40;

/// The `count` cells to measure, in rising order; the same for the same basis and criterion.
///
/// `start` is what the greedy start goes by, always an expected error: by condition numbers no first direction is better
/// than another.
pub fn choose(basis: &LogRelative, count: usize, criterion: &Criterion, start: &Criterion) -> Vec<usize> {
    let starts: Vec<Vec<usize>> = std::iter::once(greedy(basis, count, start))
        .chain((0..RANDOM_STARTS).map(|seed| random_cells(count, seed)))
        .collect();
    let ends: Vec<(Vec<usize>, f64)> = starts.into_par_iter().map(|start| descend(basis, start, criterion)).collect();
    let best = ends.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let mut chosen = best.map(|(cells, _)| cells).unwrap_or_default();
    chosen.sort_unstable();
    chosen
}

/// One direction after another, each with the largest fall of the expected error: by Sherman and Morrison's formula
/// |G½ P q|² / (1 + qᵀ P q), P = (QᵀQ + η)⁻¹.
fn greedy(basis: &LogRelative, count: usize, criterion: &Criterion) -> Vec<usize> {
    let Criterion::ExpectedError { gram, damping } = criterion else { return random_cells(count, RANDOM_STARTS) };
    let candidates: Vec<usize> = measurable().iter().copied().step_by(STRIDE).collect();
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count.min(candidates.len()) {
        let rows = basis.matrix(&chosen);
        let Some(uncertain) = posterior(&(rows.transpose() * &rows), *damping) else { break };
        let felt = &uncertain * gram * &uncertain;
        let gain = |cells: &[usize]| {
            let rows = basis.matrix(cells);
            let (fall, own) = (&rows * &felt, &rows * &uncertain);
            let along = |product: &Mat<f64>, row: usize| {
                (0..rows.ncols()).map(|k| product[(row, k)] * rows[(row, k)]).sum::<f64>()
            };
            let gain = |row: usize| along(&fall, row) / (1.0 + along(&own, row));
            (0..cells.len()).map(|row| (gain(row), cells[row])).collect::<Vec<_>>()
        };
        let gains: Vec<Vec<(f64, usize)>> = candidates.par_chunks(2048).map(gain).collect();
        let new = gains.into_iter().flatten().filter(|(_, cell)| !chosen.contains(cell));
        let Some((_, best)) = new.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))) else { break };
        chosen.push(best);
    }
    chosen
}

/// Moves the cells one at a time as long as the cost falls; the cells and their cost.
fn descend(basis: &LogRelative, mut cells: Vec<usize>, criterion: &Criterion) -> (Vec<usize>, f64) {
    let mut rows = basis.matrix(&cells);
    let mut cost = criterion.cost(&rows);
    for _ in 0..ROUNDS {
        let before = cost;
        for moved in 0..cells.len() {
            let mut best = cells[moved];
            for cell in neighbours(cells[moved]) {
                if cells.contains(&cell) {
                    continue;
                }
                set_row(&mut rows, moved, basis.loadings(cell));
                let tried = criterion.cost(&rows);
                if tried < cost {
                    (cost, best) = (tried, cell);
                }
            }
            cells[moved] = best;
            set_row(&mut rows, moved, basis.loadings(best));
        }
        if cost > (1.0 - GAIN) * before || cost.is_nan() {
            break;
        }
    }
    (cells, cost)
}

fn set_row(rows: &mut Mat<f64>, row: usize, loadings: &[f32]) {
    loadings.iter().enumerate().for_each(|(k, &v)| rows[(row, k)] = f64::from(v));
}

/// Cells above the horizon at one to sixteen steps along each axis; φ_diff goes round.
fn neighbours(cell: usize) -> impl Iterator<Item = usize> {
    let here = place(cell);
    let moved = move |axis: usize, step: usize, up: bool| {
        let mut there = here;
        there[axis] = match (axis, up) {
            (2, true) => (here[2] + step) % CELLS[2],
            (2, false) => (here[2] + CELLS[2] - step) % CELLS[2],
            (_, true) => here[axis] + step,
            (_, false) => here[axis].checked_sub(step)?,
        };
        let inside = there[axis] < CELLS[axis];
        inside.then(|| index(there)).filter(|cell| measurable().binary_search(cell).is_ok())
    };
    let steps = [1, 2, 4, 8, 16].into_iter().flat_map(|step| [(step, true), (step, false)]);
    (0..3).flat_map(move |axis| steps.clone().filter_map(move |(step, up)| moved(axis, step, up)))
}
