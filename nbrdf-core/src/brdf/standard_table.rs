//! Tabulated reflectance over the angles of light and view: 90 (θ_i) × 90 (θ_o) × 180 (φ) cells, evenly spaced.
//!
//! What is natural to measure, and what S. Rusinkiewicz, *A New Change of Variables for Efficient BRDF Representation*
//! (1998), section 2, starts from: highlights lie along θ_i = θ_o, φ = π, across the grid instead of along it. φ, from the
//! light's azimuth to the viewer's, is folded to 0..π: isotropic materials are taken to be their own mirror images.

use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

use pulp::Simd;
use rayon::prelude::*;

use super::places::{self, Placed};
use super::table::between;
use crate::sampling::evaluate;
use crate::simd::angle;
use crate::{Brdf, Directions, Rgb};

/// Cells along θ_i, θ_o, φ.
pub const CELLS: [usize; 3] = super::table::CELLS;

/// A table of reflectances, interpolated linearly between the middles of cells; edges repeat.
#[derive(Clone, Debug)]
pub struct StandardTable {
    cells: Vec<Rgb>,
}

impl StandardTable {
    /// Tabulates a reflectance at the [`middles`] of cells; none is below the horizon.
    pub fn tabulate(brdf: &dyn Brdf) -> Self {
        Self { cells: evaluate(brdf, middles()) }
    }

    /// From the values of cells, φ running fastest.
    ///
    /// # Panics
    /// If there are not as many as [`CELLS`] says (a bug of the caller).
    pub fn of_cells(cells: Vec<Rgb>) -> Self {
        assert_eq!(cells.len(), CELLS.iter().product::<usize>(), "cells of a table");
        Self { cells }
    }

    /// Bytes of the table in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(self.cells.as_slice())
    }
}

/// The pairs in the middles of all cells, φ running fastest; all above the horizon.
pub fn middles() -> &'static [Directions] {
    static MIDDLES: OnceLock<Vec<Directions>> = OnceLock::new();
    MIDDLES.get_or_init(|| {
        let [incoming, outgoing, around] = CELLS;
        let middle = |index: usize, cells: usize, range: f32| range * (index as f32 + 0.5) / cells as f32;
        let cell = |index: usize| {
            let theta_i = middle(index / (outgoing * around), incoming, FRAC_PI_2);
            let theta_o = middle(index / around % outgoing, outgoing, FRAC_PI_2);
            Directions::from_angles(theta_i, 0.0, theta_o, middle(index % around, around, PI))
        };
        (0..incoming * outgoing * around).into_par_iter().map(cell).collect()
    })
}

impl Brdf for StandardTable {
    fn eval(&self, at: Directions) -> Rgb {
        places::read_one(self, at)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        places::read(self, at, out);
    }
}

impl Placed<3> for StandardTable {
    /// In units of cells, measured from the edge of the first.
    #[inline(always)]
    fn place<S: Simd>(simd: S, [lx, ly, lz]: [S::f32s; 3], [vx, vy, vz]: [S::f32s; 3]) -> [S::f32s; 3] {
        let constant = |v: f32| simd.splat_f32s(v);
        let theta = |x, y, z| angle(simd, simd.sqrt_f32s(simd.mul_add_e_f32s(x, x, simd.mul_f32s(y, y))), z);
        // The angle between the azimuths, from their cosine and the size of their sine.
        let cosine = simd.mul_add_e_f32s(lx, vx, simd.mul_f32s(ly, vy));
        let sine = simd.sub_f32s(simd.mul_f32s(lx, vy), simd.mul_f32s(ly, vx));
        let phi = angle(simd, simd.abs_f32s(sine), cosine);
        let [incoming, outgoing, around] = CELLS.map(|cells| cells as f32);
        [
            simd.mul_f32s(theta(lx, ly, lz), constant(incoming / FRAC_PI_2)),
            simd.mul_f32s(theta(vx, vy, vz), constant(outgoing / FRAC_PI_2)),
            simd.mul_f32s(phi, constant(around / PI)),
        ]
    }

    #[inline(always)]
    fn read(&self, place: [f32; 3]) -> Rgb {
        let [(i, ti), (o, to), (p, tp)] = [0, 1, 2].map(|angle| between(place[angle], CELLS[angle]));
        let mut sum = Rgb::BLACK;
        for (i, wi) in [(i, 1.0 - ti), (i + 1, ti)] {
            for (o, wo) in [(o, 1.0 - to), (o + 1, to)] {
                for (p, wp) in [(p, 1.0 - tp), (p + 1, tp)] {
                    sum += self.cells[(i * CELLS[1] + o) * CELLS[2] + p] * (wi * wo * wp);
                }
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::brdf::lambert::Lambert;
    use crate::sampling::rus32k;

    #[test]
    fn the_same_value_everywhere_stays_the_same() {
        let grey = Lambert { albedo: Rgb([0.2, 0.5, 0.8]) };
        let table = StandardTable::tabulate(&grey);
        for &at in rus32k().iter().step_by(7) {
            assert!(table.eval(at).zip(grey.eval(at), |a, b| (a - b).abs()).max() < 1e-6);
        }
        let below = Directions::from_angles(1.8, 0.0, 0.2, 1.0);
        assert_eq!(table.eval(below), Rgb::BLACK);
    }

    #[test]
    fn a_smooth_material_is_read_back_wherever_light_and_view_are_turned_to() {
        let smooth = Ggx { diffuse: Rgb([0.3, 0.2, 0.1]), f0: Rgb([0.04, 0.5, 0.9]), alpha: 0.5 };
        let table = StandardTable::tabulate(&smooth);
        for (theta_i, theta_o, phi) in [(0.4, 0.4, 3.1), (0.9, 0.5, 1.0), (0.01, 1.0, 2.0), (1.1, 1.2, 0.02)] {
            for turn in [0.0, 2.0, -1.0] {
                for phi in [phi, -phi] {
                    let at = Directions::from_angles(theta_i, turn, theta_o, turn + phi);
                    let error = table.eval(at).zip(smooth.eval(at), |a, b| (a - b).abs() / b).max();
                    assert!(error < 0.01, "{theta_i} {theta_o} {phi} turned by {turn}: {error}");
                }
            }
        }
    }
}
