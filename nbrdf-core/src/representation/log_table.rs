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
        let grid = grid();
        let mut values = vec![Rgb::BLACK; grid.len()];
        brdf.eval_into(grid, &mut values);
        let stored = |(at, f): (&Directions, &Rgb)| f.map(|f| (f * floored(at.light.z) + DARKEST).ln()).0;
        grid.iter().zip(&values).flat_map(stored).collect()
    }

    /// A table from its [`TABLE_LEN`] numbers.
    ///
    /// # Panics
    /// If there are more or fewer (a bug of the caller).
    pub fn new(values: Vec<f32>) -> Self {
        assert_eq!(values.len(), TABLE_LEN, "numbers of a table");
        Self { values }
    }

    /// The interpolated logarithm.
    fn read(&self, at: Directions) -> Rgb {
        let [h, d, p] = CELLS;
        let angles = at.rusinkiewicz();
        let (h0, h1, th) = clamped((angles.theta_half / FRAC_PI_2).max(0.0).sqrt(), h);
        let (d0, d1, td) = clamped(angles.theta_diff / FRAC_PI_2, d);
        let turn = (angles.phi_diff / TAU).rem_euclid(1.0) * p as f32 - 0.5;
        let low = turn.floor();
        let tp = turn - low;
        let p0 = (low as i64).rem_euclid(p as i64) as usize;
        let p1 = (p0 + 1) % p;
        let mut sum = [0.0; 3];
        for (ih, wh) in [(h0, 1.0 - th), (h1, th)] {
            for (id, wd) in [(d0, 1.0 - td), (d1, td)] {
                for (ip, wp) in [(p0, 1.0 - tp), (p1, tp)] {
                    let cell = &self.values[3 * ((ih * d + id) * p + ip)..][..3];
                    let weight = wh * wd * wp;
                    for (sum, v) in sum.iter_mut().zip(cell) {
                        *sum += weight * v;
                    }
                }
            }
        }
        Rgb(sum)
    }
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
            *out = if at.is_above() {
                self.read(at).map(|v| (v.min(80.0).exp() - DARKEST) / floored(at.light.z))
            } else {
                Rgb::BLACK
            };
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
fn grid() -> &'static [Directions] {
    static GRID: OnceLock<Vec<Directions>> = OnceLock::new();
    GRID.get_or_init(|| {
        let [h, d, p] = CELLS;
        let at = |h: usize, d: usize, p: usize| {
            let angles = Rusinkiewicz {
                theta_half: FRAC_PI_2 * ((h as f32 + 0.5) / CELLS[0] as f32).powi(2),
                theta_diff: FRAC_PI_2 * (d as f32 + 0.5) / CELLS[1] as f32,
                phi_diff: TAU * (p as f32 + 0.5) / CELLS[2] as f32,
                phi_half: 0.0,
            };
            angles.directions()
        };
        let mut grid: Vec<Directions> = Vec::with_capacity(h * d * p);
        for ih in 0..h {
            for id in 0..d {
                for ip in 0..p {
                    let cell = at(ih, id, ip);
                    let above = cell.is_above() || ih == 0;
                    grid.push(if above { cell } else { grid[((ih - 1) * d + id) * p + ip] });
                }
            }
        }
        grid
    })
}
