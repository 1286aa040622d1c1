//! Tabulated reflectance in half/difference coordinates: 90 (θ_half) × 90 (θ_diff) × 180 (φ_diff) cells.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 3: θ_half spaced by the square root, the others
//! evenly; reciprocity folds φ_diff to 0..π. Cells hold the value at their middle; looked up nearest or interpolated.

mod gaps;

use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

use half::f16;
use pulp::Simd;
use rayon::prelude::*;

use super::places::{self, Placed};
use crate::nbrdf::kernel::half_diff;
use crate::sampling::evaluate;
use crate::simd::angle;
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

/// Numbers in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 32 bits each: 16 bytes per cell.
    Single,
    /// 16 bits each: 8 bytes per cell, three digits.
    Half,
}

/// A table of reflectances.
#[derive(Clone, Debug)]
pub struct Table {
    lookup: Lookup,
    cells: Cells,
}

/// Red, green, blue and weight of every cell, φ_diff running fastest: a cell is one load.
#[derive(Clone, Debug)]
enum Cells {
    Single(Vec<[f32; 4]>),
    Half(Vec<[f16; 4]>),
}

impl Cells {
    #[inline(always)]
    fn get(&self, index: usize) -> [f32; 4] {
        match self {
            Self::Single(cells) => cells[index],
            Self::Half(cells) => cells[index].map(f16::to_f32),
        }
    }
}

impl Table {
    /// Tabulates a reflectance at the [`middles`] of cells that are above the horizon.
    pub fn tabulate(brdf: &dyn Brdf, lookup: Lookup) -> Self {
        let at = middles();
        Self::of_cells(at.iter().zip(evaluate(brdf, at)).map(|(at, value)| at.is_above().then_some(value)), lookup)
    }

    /// From the values of cells, φ_diff running fastest; `None` was not measured. Such a cell repeats the nearest that was,
    /// and counts in an interpolation only where no measured one is near: what is next to a gap or the horizon mixes in
    /// nothing made up.
    ///
    /// # Panics
    /// If there are not as many as [`CELLS`] says (a bug of the caller).
    pub fn of_cells(values: impl Iterator<Item = Option<Rgb>>, lookup: Lookup) -> Self {
        Self { lookup, cells: Cells::Single(gaps::bridged(values.map(|value| value.map(|Rgb(rgb)| rgb)))) }
    }

    /// The same table in more or less memory; in half precision f_r is 65504 at most.
    pub fn with_precision(self, precision: Precision) -> Self {
        let cells = match (self.cells, precision) {
            (Cells::Single(cells), Precision::Half) => {
                let half = |v: f32| f16::from_f32(v.min(f16::MAX.to_f32()));
                Cells::Half(cells.into_iter().map(|cell| cell.map(half)).collect())
            }
            (Cells::Half(cells), Precision::Single) => {
                Cells::Single(cells.into_iter().map(|cell| cell.map(f16::to_f32)).collect())
            }
            (cells, _) => cells,
        };
        Self { cells, ..self }
    }

    /// The same table, looked up otherwise.
    pub fn with_lookup(self, lookup: Lookup) -> Self {
        Self { lookup, ..self }
    }

    /// Share of the cells above the horizon that were measured.
    pub fn measured_share(&self) -> f64 {
        let above = || (0..middles().len()).filter(|&cell| middles()[cell].is_above());
        let measured = above().filter(|&cell| self.cells.get(cell)[3] > 0.5);
        measured.count() as f64 / above().count() as f64
    }

    /// Bytes of the table in memory.
    pub fn bytes(&self) -> usize {
        match &self.cells {
            Cells::Single(cells) => size_of_val(cells.as_slice()),
            Cells::Half(cells) => size_of_val(cells.as_slice()),
        }
    }
}

/// The first of the two cells around a place in units of cells, and the weight of the second; the edges repeat.
#[inline(always)]
pub(super) fn between(at: f32, cells: usize) -> (usize, f32) {
    let at = (at - 0.5).clamp(0.0, (cells - 1) as f32);
    let low = (at as usize).min(cells - 2);
    (low, at - low as f32)
}

/// The pairs in the middles of all cells, φ_diff running fastest; some lie below the horizon.
pub fn middles() -> &'static [Directions] {
    static MIDDLES: OnceLock<Vec<Directions>> = OnceLock::new();
    MIDDLES.get_or_init(|| {
        let [half, diff, phi] = CELLS;
        let cell = |index: usize| middle(index / (diff * phi), index / phi % diff, index % phi);
        (0..half * diff * phi).into_par_iter().map(cell).collect()
    })
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
        places::read_one(self, at)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        places::read(self, at, out);
    }
}

impl Placed<3> for Table {
    /// In units of cells, measured from the edge of the first.
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

    #[inline(always)]
    fn read(&self, [h, d, p]: [f32; 3]) -> Rgb {
        let [_, diff, phi] = CELLS;
        let index = |h: usize, d: usize, p: usize| (h * diff + d) * phi + p;
        if self.lookup == Lookup::Nearest {
            let cell = |at: f32, cells: usize| (at as usize).min(cells - 1);
            let [r, g, b, _] = self.cells.get(index(cell(h, CELLS[0]), cell(d, diff), cell(p, phi)));
            return Rgb([r, g, b]);
        }
        let ((h, th), (d, td)) = (between(h, CELLS[0]), between(d, diff));
        // φ_diff goes round.
        let at = p + (phi as f32 - 0.5);
        let low = at as usize;
        let tp = at - low as f32;
        let phis = [(low % phi, 1.0 - tp), ((low + 1) % phi, tp)];
        let mut sum = [0.0; 4];
        for (h, wh) in [(h, 1.0 - th), (h + 1, th)] {
            for (d, wd) in [(d, 1.0 - td), (d + 1, td)] {
                for (p, wp) in phis {
                    let [r, g, b, measured] = self.cells.get(index(h, d, p));
                    let weight = wh * wd * wp * measured;
                    for (sum, value) in sum.iter_mut().zip([r, g, b, 1.0]) {
                        *sum += weight * value;
                    }
                }
            }
        }
        Rgb([sum[0], sum[1], sum[2]]) * (1.0 / sum[3])
    }
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
    fn half_precision_takes_half_the_memory_and_costs_three_digits() {
        let single = Table::tabulate(&SMOOTH, Lookup::Trilinear);
        let half = single.clone().with_precision(Precision::Half);
        assert_eq!(2 * half.bytes(), single.bytes());
        for &at in rus32k().iter().step_by(17) {
            let relative = single.eval(at).zip(half.eval(at), |a, b| (a - b).abs() / a.max(1e-3)).max();
            assert!(relative < 2e-3, "{relative}");
        }
    }

    #[test]
    fn a_gap_is_bridged_by_what_is_around_it() {
        let grey = Rgb([0.2, 0.5, 0.8]);
        let middles = middles();
        let measured = |(index, _): (usize, &Directions)| (index % 3 == 0 && index > 50_000).then_some(grey);
        let table = Table::of_cells(middles.iter().enumerate().map(measured), Lookup::Trilinear);
        for &at in rus32k().iter().step_by(7).filter(|at| at.rusinkiewicz().theta_half > 0.2) {
            assert!(table.eval(at).zip(grey, |a, b| (a - b).abs()).max() < 1e-5, "{at:?}");
        }
    }

    #[test]
    fn what_lies_below_the_horizon_counts_as_neither_measured_nor_missing() {
        let every = |n: usize| {
            let measured =
                |(index, at): (usize, &Directions)| (at.is_above() && index % n == 0).then_some(Rgb::splat(0.1));
            Table::of_cells(middles().iter().enumerate().map(measured), Lookup::Nearest).measured_share()
        };
        assert_eq!(every(1), 1.0);
        assert!((every(4) - 0.25).abs() < 1e-3, "{}", every(4));
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
