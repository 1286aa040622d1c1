//! Cells that were not measured take the value of the nearest that was.

use super::CELLS;

/// How much such a cell counts in an interpolation: only where there is nothing else.
const FILLED: f32 = 1e-6;

/// Cells with their weights: 1 where a value was measured; elsewhere the value of the nearest measured cell, counted in
/// steps along the axes, and next to no weight. All black where nothing was measured.
///
/// # Panics
/// If there are not as many as [`CELLS`] says (a bug of the caller).
pub(super) fn bridged(values: impl Iterator<Item = Option<[f32; 3]>>) -> Vec<[f32; 4]> {
    const NOTHING: [f32; 4] = [0.0, 0.0, 0.0, 0.0];
    let mut cells: Vec<[f32; 4]> = values.map(|v| v.map_or(NOTHING, |[r, g, b]| [r, g, b, 1.0])).collect();
    assert_eq!(cells.len(), CELLS.iter().product::<usize>(), "cells of a table");
    let missing = |cell: &[f32; 4]| cell[3] == 0.0;
    // From the measured cells outwards, breadth first; the order is that of the cells, the same every time.
    let mut reached: Vec<u32> = (0..cells.len() as u32).filter(|&i| !missing(&cells[i as usize])).collect();
    let mut next = 0;
    while let Some(&index) = reached.get(next) {
        next += 1;
        let [r, g, b, _] = cells[index as usize];
        for neighbour in neighbours(index as usize).into_iter().flatten() {
            if missing(&cells[neighbour]) {
                cells[neighbour] = [r, g, b, FILLED];
                reached.push(neighbour as u32);
            }
        }
    }
    if reached.is_empty() {
        cells.fill([0.0, 0.0, 0.0, FILLED]);
    }
    cells
}

/// One step along each axis and back; φ_diff goes round.
fn neighbours(index: usize) -> [Option<usize>; 6] {
    let [half, diff, phi] = CELLS;
    let [h, d, p] = [index / (diff * phi), index / phi % diff, index % phi];
    let row = index - p;
    [
        (h > 0).then(|| index - diff * phi),
        (d > 0).then(|| index - phi),
        Some(row + (p + 1) % phi),
        Some(row + (p + phi - 1) % phi),
        (d + 1 < diff).then(|| index + phi),
        (h + 1 < half).then(|| index + diff * phi),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: usize = CELLS[0] * CELLS[1] * CELLS[2];

    #[test]
    fn a_single_measured_cell_fills_the_table_and_keeps_its_weight() {
        let cells = bridged((0..COUNT).map(|i| (i == 700_000).then_some([0.1, 0.2, 0.3])));
        for (i, cell) in cells.iter().enumerate() {
            assert_eq!(*cell, [0.1, 0.2, 0.3, if i == 700_000 { 1.0 } else { FILLED }]);
        }
    }

    #[test]
    fn the_nearer_of_two_is_taken_round_the_circle_too() {
        let cells = bridged((0..COUNT).map(|i| match i {
            0 => Some([1.0; 3]),
            90 => Some([2.0; 3]),
            _ => None,
        }));
        assert_eq!([cells[44][0], cells[46][0], cells[CELLS[2] - 1][0], cells[134][0]], [1.0, 2.0, 1.0, 2.0]);
    }

    #[test]
    fn where_nothing_was_measured_all_is_black() {
        assert!(bridged((0..COUNT).map(|_| None)).iter().all(|cell| *cell == [0.0, 0.0, 0.0, FILLED]));
    }
}
