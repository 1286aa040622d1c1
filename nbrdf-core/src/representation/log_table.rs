//! A table of ln(f c + 10⁻³) over (θ_half, θ_diff, φ_diff), read by linear interpolation.
//!
//! PROTOCOL of this project, "PCA-32": c = cos θ_i floored at 0.05, 60 × 40 × 80 cells, θ_half spaced as t² after
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 3; φ_diff over the whole circle, never folded.

use std::f32::consts::{FRAC_PI_2, TAU};
use std::sync::OnceLock;

use crate::nbrdf::objective::DARKEST;
use crate::{Brdf, Directions, Rgb, Rusinkiewicz};

/// Cells along θ_half, θ_diff, φ_diff.
pub const CELLS: [usize; 3] = [60, 40, 80];
/// Numbers in a table: every cell, three channels.
pub const TABLE_LEN: usize = 3 * CELLS[0] * CELLS[1] * CELLS[2];
/// cos θ_i is never taken as less.
const COSINE_FLOOR: f32 = 0.05;

/// ln(f c + 10⁻³), index `((θ_half · 40 + θ_diff) · 80 + φ_diff) · 3 + channel`.
pub struct LogTable {
    values: Vec<f32>,
}

impl LogTable {
    /// Tabulates a reflectance.
    pub fn tabulate(brdf: &dyn Brdf) -> Vec<f32> {
        let grid = cells();
        let mut values = vec![Rgb::BLACK; grid.len()];
        brdf.eval_into(grid, &mut values);
        grid.iter().zip(&values).flat_map(|(&at, &f)| Self::stored(at, f).0).collect()
    }

    /// A table from its [`TABLE_LEN`] numbers.
    ///
    /// # Panics
    /// If there are more or fewer (a bug of the caller).
    pub fn new(values: Vec<f32>) -> Self {
        assert_eq!(values.len(), TABLE_LEN, "numbers of a table");
        Self { values }
    }

    /// What a table holds of a reflectance \[1/sr\] at a pair: ln(f c + 10⁻³).
    pub fn stored(at: Directions, f: Rgb) -> Rgb {
        f.map(|f| (f * floored(at.light.z) + DARKEST).ln())
    }

    /// The reflectance \[1/sr\] at a pair of which a table holds this; negative below ln 10⁻³.
    pub(crate) fn restored(at: Directions, stored: Rgb) -> Rgb {
        stored.map(|v| (v.min(80.0).exp() - DARKEST) / floored(at.light.z))
    }
}

/// The interpolated logarithm between the [`corners`] of a pair.
#[inline]
pub(crate) fn interpolated(values: &[f32], corners: &[(usize, f32); 8]) -> Rgb {
    let mut sum = [0.0; 3];
    for (cell, weight) in corners {
        for (sum, v) in sum.iter_mut().zip(&values[3 * cell..][..3]) {
            *sum += weight * v;
        }
    }
    Rgb(sum)
}

/// The eight cells around a pair and the weight of each; the weights sum to 1.
#[inline]
pub(crate) fn corners(at: Directions) -> [(usize, f32); 8] {
    let [h, d, p] = CELLS;
    let angles = at.rusinkiewicz();
    let (h0, h1, th) = clamped((angles.theta_half / FRAC_PI_2).max(0.0).sqrt(), h);
    let (d0, d1, td) = clamped(angles.theta_diff / FRAC_PI_2, d);
    let turn = (angles.phi_diff / TAU).rem_euclid(1.0) * p as f32 - 0.5;
    let low = turn.floor();
    let tp = turn - low;
    let p0 = (low as i64).rem_euclid(p as i64) as usize;
    let p1 = (p0 + 1) % p;
    let (halves, diffs, turns) = ([(h0, 1.0 - th), (h1, th)], [(d0, 1.0 - td), (d1, td)], [(p0, 1.0 - tp), (p1, tp)]);
    std::array::from_fn(|corner| {
        let [(ih, wh), (id, wd), (ip, wp)] = [halves[corner >> 2], diffs[(corner >> 1) & 1], turns[corner & 1]];
        (index([ih, id, ip]), wh * wd * wp)
    })
}

/// Where a cell is in the table.
pub(crate) const fn index([half, diff, phi]: [usize; 3]) -> usize {
    (half * CELLS[1] + diff) * CELLS[2] + phi
}

/// Which cell along θ_half, θ_diff, φ_diff is at that index.
pub(crate) const fn place(index: usize) -> [usize; 3] {
    [index / (CELLS[1] * CELLS[2]), index / CELLS[2] % CELLS[1], index % CELLS[2]]
}

impl Brdf for LogTable {
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
            *out =
                if at.is_above() { Self::restored(at, interpolated(&self.values, &corners(at))) } else { Rgb::BLACK };
        }
    }
}

fn floored(cosine: f32) -> f32 {
    cosine.max(COSINE_FLOOR)
}

/// The two cells around a coordinate in 0..1 and the weight of the second; the edges repeat.
fn clamped(t: f32, cells: usize) -> (usize, usize, f32) {
    let position = (t * cells as f32 - 0.5).clamp(0.0, (cells - 1) as f32);
    let low = (position as usize).min(cells - 2);
    (low, low + 1, position - low as f32)
}

/// Directions of all cells. A cell below the horizon repeats the last one above it towards smaller θ_half,
/// so that interpolation next to the horizon never mixes in a made-up zero.
pub fn cells() -> &'static [Directions] {
    static GRID: OnceLock<Vec<Directions>> = OnceLock::new();
    GRID.get_or_init(|| sources().iter().map(|&source| middle(source)).collect())
}

/// For every cell the one whose directions it has: itself where it is above the horizon.
pub(crate) fn sources() -> &'static [usize] {
    static SOURCES: OnceLock<Vec<usize>> = OnceLock::new();
    SOURCES.get_or_init(|| {
        let [h, d, p] = CELLS;
        let mut sources: Vec<usize> = Vec::with_capacity(h * d * p);
        for cell in 0..h * d * p {
            let own = cell < d * p || middle(cell).is_above();
            sources.push(if own { cell } else { sources[cell - d * p] });
        }
        sources
    })
}

/// The cells that are above the horizon themselves, in order: what can be measured of a table.
pub fn measurable() -> &'static [usize] {
    static MEASURABLE: OnceLock<Vec<usize>> = OnceLock::new();
    MEASURABLE.get_or_init(|| {
        let own = |(cell, &source): (usize, &usize)| (cell == source && middle(cell).is_above()).then_some(cell);
        sources().iter().enumerate().filter_map(own).collect()
    })
}

/// The pair in the middle of a cell; it may lie below the horizon.
fn middle(cell: usize) -> Directions {
    let [h, d, p] = place(cell);
    let angles = Rusinkiewicz {
        theta_half: FRAC_PI_2 * ((h as f32 + 0.5) / CELLS[0] as f32).powi(2),
        theta_diff: FRAC_PI_2 * (d as f32 + 0.5) / CELLS[1] as f32,
        phi_diff: TAU * (p as f32 + 0.5) / CELLS[2] as f32,
        phi_half: 0.0,
    };
    angles.directions()
}
