//! Grids of (θ_half, θ_diff, φ_diff) over which tables of linear models are learned, read by linear interpolation.
//!
//! θ_half is spaced as t² (W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 3), the others evenly.

use std::f32::consts::{FRAC_PI_2, PI, TAU};
use std::sync::OnceLock;

use serde::{Deserialize, Serialize};

use crate::{Directions, Rusinkiewicz};

/// Where a table has cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Grid {
    /// 60 × 40 × 80, φ_diff over the whole circle, never folded (PROTOCOL of this project, "PCA-32"): 576 000 numbers.
    Coarse,
    /// 90 × 90 × 180, φ_diff over half the circle: that of the MERL database, 4 374 000 numbers. Pairs of the other half are
    /// looked up with light and view exchanged.
    Merl,
}

impl Grid {
    /// Cells along θ_half, θ_diff, φ_diff.
    pub const fn cells(self) -> [usize; 3] {
        match self {
            Self::Coarse => [60, 40, 80],
            Self::Merl => crate::brdf::table::CELLS,
        }
    }

    /// Numbers in a table: every cell, three channels.
    pub const fn numbers(self) -> usize {
        let [h, d, p] = self.cells();
        3 * h * d * p
    }

    /// The pair under which `at` is looked up.
    pub(super) fn folded(self, at: Directions) -> Directions {
        // φ_diff of the exchanged pair is half a turn away.
        if self == Self::Merl && at.half_diff().diff.y < 0.0 { at.swapped() } else { at }
    }

    /// The eight cells around a [`folded`](Self::folded) pair, index `(θ_half · cells + θ_diff) · cells + φ_diff`, and their
    /// weights, whose sum is 1.
    pub(super) fn around(self, at: Directions) -> [(usize, f32); 8] {
        let [h, d, p] = self.cells();
        let angles = at.rusinkiewicz();
        let (h0, h1, th) = clamped((angles.theta_half / FRAC_PI_2).max(0.0).sqrt(), h);
        let (d0, d1, td) = clamped(angles.theta_diff / FRAC_PI_2, d);
        let (p0, p1, tp) = match self {
            Self::Coarse => cyclic(angles.phi_diff / TAU, p),
            // Half a turn further, light and view have changed places and the cosine is another: nothing goes round.
            Self::Merl => clamped(angles.phi_diff / PI, p),
        };
        let mut around = [(0, 0.0); 8];
        let mut next = around.iter_mut();
        for (ih, wh) in [(h0, 1.0 - th), (h1, th)] {
            for (id, wd) in [(d0, 1.0 - td), (d1, td)] {
                for (ip, wp) in [(p0, 1.0 - tp), (p1, tp)] {
                    if let Some(corner) = next.next() {
                        *corner = ((ih * d + id) * p + ip, wh * wd * wp);
                    }
                }
            }
        }
        around
    }

    /// Directions of all cells. A cell below the horizon repeats the last one above it towards smaller θ_half, so that
    /// interpolation next to the horizon never mixes in a made-up zero.
    pub(super) fn directions(self) -> &'static [Directions] {
        static COARSE: OnceLock<Vec<Directions>> = OnceLock::new();
        static MERL: OnceLock<Vec<Directions>> = OnceLock::new();
        match self {
            Self::Coarse => COARSE.get_or_init(|| self.middles(TAU)),
            Self::Merl => MERL.get_or_init(|| self.middles(PI)),
        }
    }

    fn middles(self, circle: f32) -> Vec<Directions> {
        let [h, d, p] = self.cells();
        let at = |ih: usize, id: usize, ip: usize| {
            let angles = Rusinkiewicz {
                theta_half: FRAC_PI_2 * ((ih as f32 + 0.5) / h as f32).powi(2),
                theta_diff: FRAC_PI_2 * (id as f32 + 0.5) / d as f32,
                phi_diff: circle * (ip as f32 + 0.5) / p as f32,
                phi_half: 0.0,
            };
            angles.directions()
        };
        let mut middles: Vec<Directions> = Vec::with_capacity(h * d * p);
        for ih in 0..h {
            for id in 0..d {
                for ip in 0..p {
                    let cell = at(ih, id, ip);
                    let above = cell.is_above() || ih == 0;
                    middles.push(if above { cell } else { middles[((ih - 1) * d + id) * p + ip] });
                }
            }
        }
        middles
    }
}

/// The two cells around a coordinate in 0..1 and the weight of the second; the edges repeat.
fn clamped(t: f32, cells: usize) -> (usize, usize, f32) {
    let position = (t * cells as f32 - 0.5).clamp(0.0, (cells - 1) as f32);
    let low = (position as usize).min(cells - 2);
    (low, low + 1, position - low as f32)
}

/// The same for a coordinate that goes round.
fn cyclic(t: f32, cells: usize) -> (usize, usize, f32) {
    let turn = t.rem_euclid(1.0) * cells as f32 - 0.5;
    let low = turn.floor();
    let first = (low as i64).rem_euclid(cells as i64) as usize;
    (first, (first + 1) % cells, turn - low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::rus32k;

    #[test]
    fn weights_of_the_cells_around_any_pair_sum_to_one() {
        for grid in [Grid::Coarse, Grid::Merl] {
            for &at in rus32k().iter().step_by(11) {
                let around = grid.around(grid.folded(at));
                let sum: f32 = around.iter().map(|(_, weight)| weight).sum();
                assert!((sum - 1.0).abs() < 1e-5 && around.iter().all(|&(cell, _)| 3 * cell < grid.numbers()));
            }
        }
    }

    #[test]
    fn a_cell_is_found_at_its_own_middle() {
        for grid in [Grid::Coarse, Grid::Merl] {
            for (cell, &at) in grid.directions().iter().enumerate().step_by(997) {
                // Cells that repeat another are found there.
                let found = grid.around(grid.folded(at)).into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
                let found = found.map(|(cell, _)| grid.directions()[cell]);
                assert_eq!(found, Some(at), "{grid:?} {cell}");
            }
        }
    }
}
