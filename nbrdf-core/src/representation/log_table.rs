//! Tables of ln(f c + 10⁻³) over the coarse grid, cell by cell: what sums of measured materials, charts and chosen
//! directions are made of.
//!
//! PROTOCOL of this project, "PCA-32": [`Grid::Coarse`] of [`Values::Log`], index `cell · 3 + channel`, cells numbered
//! `(θ_half · 40 + θ_diff) · 80 + φ_diff`.

use std::sync::OnceLock;

use super::grid::Grid;
use super::value_table::ValueTable;
use super::values::Values;
use crate::{Brdf, Directions, Rgb};

pub(super) use super::value_table::interpolated;

/// Cells along θ_half, θ_diff, φ_diff.
pub const CELLS: [usize; 3] = Grid::Coarse.cells();
/// Numbers in a table: every cell, three channels.
pub const TABLE_LEN: usize = Grid::Coarse.numbers();

/// The numbers of a reflectance.
pub fn tabulate(brdf: &dyn Brdf) -> Vec<f32> {
    ValueTable::tabulate(brdf, Values::Log, Grid::Coarse)
}

/// The reflectance of [`TABLE_LEN`] numbers.
///
/// # Panics
/// If there are more or fewer (a bug of the caller).
pub fn table(numbers: Vec<f32>) -> ValueTable {
    ValueTable::new(Values::Log, Grid::Coarse, numbers)
}

/// What a table holds of a reflectance \[1/sr\] at a pair.
pub fn stored(at: Directions, f: Rgb) -> Rgb {
    f.map(|f| Values::Log.stored(at, f))
}

/// The reflectance \[1/sr\] at a pair of which a table holds this; negative below ln 10⁻³.
pub(crate) fn restored(at: Directions, stored: Rgb) -> Rgb {
    Values::Log.reflectance(at, stored)
}

/// The eight cells around a pair and the weight of each; the weights sum to 1.
pub(crate) fn corners(at: Directions) -> [(usize, f32); 8] {
    Grid::Coarse.around(at)
}

/// Where a cell is in the table.
pub(crate) const fn index([half, diff, phi]: [usize; 3]) -> usize {
    (half * CELLS[1] + diff) * CELLS[2] + phi
}

/// Which cell along θ_half, θ_diff, φ_diff is at that index.
pub(crate) const fn place(index: usize) -> [usize; 3] {
    [index / (CELLS[1] * CELLS[2]), index / CELLS[2] % CELLS[1], index % CELLS[2]]
}

/// Directions of all cells; one below the horizon has those of the last one above it towards smaller θ_half.
pub fn cells() -> &'static [Directions] {
    Grid::Coarse.directions()
}

/// For every cell the one whose directions it has: itself where it is above the horizon.
pub(crate) fn sources() -> &'static [usize] {
    static SOURCES: OnceLock<Vec<usize>> = OnceLock::new();
    SOURCES.get_or_init(|| {
        let (all, ring) = (cells(), CELLS[1] * CELLS[2]);
        let mut sources: Vec<usize> = Vec::with_capacity(all.len());
        for cell in 0..all.len() {
            let repeats = cell >= ring && all[cell] == all[cell - ring];
            sources.push(if repeats { sources[cell - ring] } else { cell });
        }
        sources
    })
}

/// The cells that are above the horizon themselves, in order: what can be measured of a table.
pub fn measurable() -> &'static [usize] {
    static MEASURABLE: OnceLock<Vec<usize>> = OnceLock::new();
    MEASURABLE.get_or_init(|| {
        let own = |(cell, &source): (usize, &usize)| (cell == source && cells()[cell].is_above()).then_some(cell);
        sources().iter().enumerate().filter_map(own).collect()
    })
}
