//! A table of [`Values`] over a [`Grid`], read by linear interpolation.

use super::grid::Grid;
use super::values::Values;
use crate::{Brdf, Directions, Rgb};

/// Stored numbers, index `cell · 3 + channel`.
pub struct ValueTable {
    values: Values,
    grid: Grid,
    numbers: Vec<f32>,
}

impl ValueTable {
    /// Tabulates a reflectance: the [`numbers`](Grid::numbers) of a table.
    pub fn tabulate(brdf: &dyn Brdf, values: Values, grid: Grid) -> Vec<f32> {
        Self::tabulate_at(brdf, values, grid.directions())
    }

    /// As [`tabulate`](Self::tabulate), of some of a grid's directions.
    pub(super) fn tabulate_at(brdf: &dyn Brdf, values: Values, at: &[Directions]) -> Vec<f32> {
        let mut reflectances = vec![Rgb::BLACK; at.len()];
        brdf.eval_into(at, &mut reflectances);
        let stored = |(&at, f): (&Directions, &Rgb)| f.map(|f| values.stored(at, f)).0;
        at.iter().zip(&reflectances).flat_map(stored).collect()
    }

    /// A table from its numbers.
    ///
    /// # Panics
    /// If there are more or fewer than the grid has (a bug of the caller).
    pub fn new(values: Values, grid: Grid, numbers: Vec<f32>) -> Self {
        assert_eq!(numbers.len(), grid.numbers(), "numbers of a table");
        Self { values, grid, numbers }
    }
}

/// The stored number between these cells.
pub(super) fn interpolated(numbers: &[f32], around: &[(usize, f32); 8]) -> Rgb {
    let mut sum = [0.0; 3];
    for &(cell, weight) in around {
        for (sum, v) in sum.iter_mut().zip(&numbers[3 * cell..][..3]) {
            *sum += weight * v;
        }
    }
    Rgb(sum)
}

impl Brdf for ValueTable {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_signed_into(&[at], &mut out);
        out[0].map(|f| f.max(0.0))
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.eval_signed_into(at, out);
        out.iter_mut().for_each(|f| *f = f.map(|f| f.max(0.0)));
    }

    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        assert_eq!(at.len(), out.len(), "one output per pair of directions");
        for (&at, out) in at.iter().zip(out) {
            *out = if at.is_above() {
                let at = self.grid.folded(at);
                self.values.reflectance(at, interpolated(&self.numbers, &self.grid.around(at)))
            } else {
                Rgb::BLACK
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::sampling::{evaluate, evaluate_signed, rus32k};

    #[test]
    fn a_smooth_material_is_read_back_from_every_kind_and_grid() {
        let smooth = Ggx { diffuse: Rgb([0.3, 0.2, 0.1]), f0: Rgb([0.04, 0.5, 0.9]), alpha: 0.4 };
        let at: Vec<Directions> = rus32k().iter().filter(|at| at.light.z.min(at.view.z) > 0.2).copied().collect();
        for values in Values::ALL {
            for (grid, tolerance) in [(Grid::Coarse, 0.08), (Grid::Merl, 0.03)] {
                let table = ValueTable::new(values, grid, ValueTable::tabulate(&smooth, values, grid));
                let pairs = evaluate(&smooth, &at).into_iter().zip(evaluate(&table, &at));
                let worst =
                    pairs.map(|(exact, read)| exact.zip(read, |a, b| (a - b).abs() / a).max()).fold(0.0, f32::max);
                assert!(worst < tolerance, "{} {grid:?}: {worst}", values.name());
            }
        }
    }

    #[test]
    fn logarithms_are_never_below_what_a_thousandth_over_the_cosine_stands_for_and_plain_values_are() {
        let lowest = |values: Values, number: f32| {
            let table = ValueTable::new(values, Grid::Coarse, vec![number; Grid::Coarse.numbers()]);
            let signed = evaluate_signed(&table, rus32k());
            assert!(evaluate(&table, rus32k()).iter().all(|f| f.min() >= 0.0));
            signed.iter().zip(rus32k()).map(|(f, at)| f.min() * at.light.z).fold(f32::INFINITY, f32::min)
        };
        assert!(lowest(Values::Log, -1e30) >= -1.001e-3);
        assert!(lowest(Values::Plain, -2.0) < -1.0);
    }
}
