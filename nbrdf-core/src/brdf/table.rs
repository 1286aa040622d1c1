//! Tabulated reflectance in half/difference coordinates: 90 (θ_half) × 90 (θ_diff) × 180 (φ_diff) cells.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 3: θ_half spaced by the square root, the others
//! evenly; reciprocity folds φ_diff to 0..π. Cells hold the value at their middle; looked up nearest or interpolated.

use std::f32::consts::{FRAC_PI_2, PI};

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::pairs::{Pairs, above};
use crate::nbrdf::kernel::half_diff;
use crate::simd::{InstructionSet, LANES, Lanes, angle};
use crate::{Brdf, Directions, Rgb, Rusinkiewicz};

/// Cells along θ_half, θ_diff, φ_diff.
pub const CELLS: [usize; 3] = [90, 90, 180];

/// How values between the middles of cells are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lookup {
    /// The value of the cell.
    Nearest,
    /// Linear between the eight cells around, clamped at the ends of θ_half and θ_diff.
    Trilinear,
}

/// A table of reflectances.
#[derive(Clone, Debug)]
pub struct Table {
    lookup: Lookup,
    /// Red, green, blue and nothing of every cell, φ_diff running fastest: a cell is one load of 16 bytes.
    cells: Vec<[f32; 4]>,
}

impl Table {
    /// Tabulates a reflectance. A cell whose middle is below the horizon repeats the last one above it towards smaller
    /// θ_half, so that interpolation next to the horizon mixes in no made-up zero.
    pub fn tabulate(brdf: &dyn Brdf, lookup: Lookup) -> Self {
        let [half, diff, phi] = CELLS;
        let mut cells = vec![[0.0; 4]; half * diff * phi];
        cells.par_chunks_mut(diff * phi).enumerate().for_each(|(h, cells)| {
            let at: Vec<Directions> = (0..diff * phi).map(|i| middle(h, i / phi, i % phi)).collect();
            let mut values = vec![Rgb::BLACK; at.len()];
            brdf.eval_into(&at, &mut values);
            cells.iter_mut().zip(values).for_each(|(cell, Rgb([r, g, b]))| *cell = [r, g, b, 0.0]);
        });
        for h in 1..half {
            for i in 0..diff * phi {
                if !middle(h, i / phi, i % phi).is_above() {
                    cells[h * diff * phi + i] = cells[(h - 1) * diff * phi + i];
                }
            }
        }
        Self { lookup, cells }
    }

    /// The same table, looked up otherwise.
    pub fn with_lookup(self, lookup: Lookup) -> Self {
        Self { lookup, ..self }
    }

    /// Bytes of the table in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(self.cells.as_slice())
    }

    /// The value at a place in units of cells, measured from the edge of the first.
    #[inline(always)]
    fn read(&self, [h, d, p]: [f32; 3]) -> Rgb {
        let [_, diff, phi] = CELLS;
        let index = |h: usize, d: usize, p: usize| (h * diff + d) * phi + p;
        if self.lookup == Lookup::Nearest {
            let cell = |at: f32, cells: usize| (at as usize).min(cells - 1);
            let [r, g, b, _] = self.cells[index(cell(h, CELLS[0]), cell(d, diff), cell(p, phi))];
            return Rgb([r, g, b]);
        }
        let clamped = |at: f32, cells: usize| {
            let at = (at - 0.5).clamp(0.0, (cells - 1) as f32);
            let low = (at as usize).min(cells - 2);
            (low, at - low as f32)
        };
        let ((h, th), (d, td)) = (clamped(h, CELLS[0]), clamped(d, diff));
        // φ_diff goes round.
        let at = p + (phi as f32 - 0.5);
        let low = at as usize;
        let tp = at - low as f32;
        let phis = [(low % phi, 1.0 - tp), ((low + 1) % phi, tp)];
        let mut sum = [0.0; 4];
        for (h, wh) in [(h, 1.0 - th), (h + 1, th)] {
            for (d, wd) in [(d, 1.0 - td), (d + 1, td)] {
                for (p, wp) in phis {
                    let (cell, weight) = (&self.cells[index(h, d, p)], wh * wd * wp);
                    for (sum, value) in sum.iter_mut().zip(cell) {
                        *sum += weight * value;
                    }
                }
            }
        }
        Rgb([sum[0], sum[1], sum[2]])
    }
}

/// The pair in the middle of a cell.
fn middle(half: usize, diff: usize, phi: usize) -> Directions {
    let along = |index: usize, cells: usize| (index as f32 + 0.5) / cells as f32;
    Rusinkiewicz {
        theta_half: FRAC_PI_2 * along(half, CELLS[0]).powi(2),
        theta_diff: FRAC_PI_2 * along(diff, CELLS[1]),
        phi_diff: PI * along(phi, CELLS[2]),
        phi_half: 0.0,
    }
    .directions()
}

impl Brdf for Table {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_into(&[at], &mut out);
        out[0]
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        assert_eq!(at.len(), out.len(), "one output per pair of directions");
        InstructionSet::fastest().run(Read { table: self, at, out });
    }
}

struct Read<'a> {
    table: &'a Table,
    at: &'a [Directions],
    out: &'a mut [Rgb],
}

impl WithSimd for Read<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (at, out) in self.at.chunks(LANES).zip(self.out.chunks_mut(LANES)) {
            let pairs = Pairs::load(at);
            let mut places = [Lanes::ZERO; 3];
            for i in 0..LANES / S::F32_LANES {
                let [light, view] = pairs.vectors::<S>(i);
                for (lanes, place) in places.iter_mut().zip(place(simd, light, view)) {
                    lanes.vectors_mut::<S>()[i] = place;
                }
            }
            let above = above(at);
            for (lane, out) in out.iter_mut().enumerate() {
                let place = [places[0].0[lane], places[1].0[lane], places[2].0[lane]];
                *out = if (above >> lane) & 1 == 1 { self.table.read(place) } else { Rgb::BLACK };
            }
        }
    }
}

/// Where in the table, in units of cells.
#[inline(always)]
fn place<S: Simd>(simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 3] {
    let constant = |v: f32| simd.splat_f32s(v);
    let [hx, hz, dx, dy, dz] = half_diff(simd, light, view);
    let theta_half = angle(simd, hx, hz);
    let across = simd.sqrt_f32s(simd.mul_add_e_f32s(dx, dx, simd.mul_f32s(dy, dy)));
    let theta_diff = angle(simd, across, dz);
    // (dx, dy) and its opposite are the same by reciprocity.
    let below = simd.greater_than_f32s(constant(0.0), dy);
    let [dx, dy] = [dx, dy].map(|v| simd.select_f32s(below, simd.neg_f32s(v), v));
    let [half, diff, phi] = CELLS.map(|cells| cells as f32);
    [
        simd.mul_f32s(constant(half), simd.sqrt_f32s(simd.mul_f32s(theta_half, constant(1.0 / FRAC_PI_2)))),
        simd.mul_f32s(theta_diff, constant(diff / FRAC_PI_2)),
        simd.mul_f32s(angle(simd, dy, dx), constant(phi / PI)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::brdf::lambert::Lambert;
    use crate::sampling::{evaluate, rus32k};

    const SMOOTH: Ggx = Ggx { diffuse: Rgb([0.3, 0.2, 0.1]), f0: Rgb([0.04, 0.5, 0.9]), alpha: 0.4 };

    fn error(lookup: Lookup) -> f32 {
        let table = Table::tabulate(&SMOOTH, lookup);
        let at: Vec<Directions> = rus32k().iter().filter(|at| at.light.z > 0.2 && at.view.z > 0.2).copied().collect();
        let pairs = evaluate(&SMOOTH, &at).into_iter().zip(evaluate(&table, &at));
        let relative = pairs.map(|(exact, read)| exact.zip(read, |a, b| (a - b).abs() / a).max());
        relative.fold(0.0, f32::max)
    }

    #[test]
    fn a_smooth_material_is_read_back_and_interpolation_is_closer() {
        let (nearest, trilinear) = (error(Lookup::Nearest), error(Lookup::Trilinear));
        assert!(nearest < 0.1 && trilinear < 0.01, "nearest {nearest}, trilinear {trilinear}");
    }

    #[test]
    fn the_same_value_everywhere_stays_the_same() {
        let grey = Lambert { albedo: Rgb([0.2, 0.5, 0.8]) };
        for lookup in [Lookup::Nearest, Lookup::Trilinear] {
            let table = Table::tabulate(&grey, lookup);
            for &at in rus32k().iter().step_by(7) {
                assert!(table.eval(at).zip(grey.eval(at), |a, b| (a - b).abs()).max() < 1e-6);
                assert!(table.eval(at.swapped()).zip(grey.eval(at), |a, b| (a - b).abs()).max() < 1e-6);
            }
        }
    }
}
