//! One block of directions as network inputs, lanes side by side.

use super::{INPUTS, LANES, Lanes};
use crate::{Directions, HalfDiff};

/// From half and difference vectors; unused lanes repeat the last one.
#[inline(always)]
pub(crate) fn load(block: &[HalfDiff], input: &mut [Lanes; INPUTS]) {
    let at: [[f32; INPUTS]; LANES] = std::array::from_fn(|lane| {
        let HalfDiff { half, diff } = block[lane.min(block.len() - 1)];
        [half.x, half.y, half.z, diff.x, diff.y, diff.z]
    });
    for (channel, lanes) in input.iter_mut().enumerate() {
        for (value, at) in lanes.iter_mut().zip(&at) {
            *value = at[channel];
        }
    }
}

/// Half and difference vectors of one block; the same arithmetic as [`Directions::half_diff`], all lanes at once.
///
/// In f64: with f32 the error of the glossiest published network is twice as large.
#[inline(always)]
pub(super) fn convert(block: &[Directions], input: &mut [Lanes; INPUTS]) {
    let mut light = [[0.0f64; LANES]; 3];
    let mut view = [[0.0f64; LANES]; 3];
    for lane in 0..LANES {
        let Directions { light: l, view: v } = block[lane.min(block.len() - 1)];
        for axis in 0..3 {
            light[axis][lane] = f64::from(l[axis]);
            view[axis][lane] = f64::from(v[axis]);
        }
    }
    for lane in 0..LANES {
        let [lx, ly, lz] = light.map(|axis| axis[lane]);
        let [vx, vy, vz] = view.map(|axis| axis[lane]);
        let (x, y, z) = (lx + vx, ly + vy, lz + vz);
        let scale = 1.0 / (x * x + y * y + z * z).sqrt();
        let (hx, hy, hz) = (x * scale, y * scale, z * scale);
        let sin = (hx * hx + hy * hy).sqrt();
        let inverse = if sin > 0.0 { 1.0 / sin } else { 0.0 };
        let (cos_phi, sin_phi) = (if sin > 0.0 { hx * inverse } else { 1.0 }, hy * inverse);
        let along = cos_phi * lx + sin_phi * ly;
        input[0][lane] = sin as f32;
        input[1][lane] = 0.0;
        input[2][lane] = hz as f32;
        input[3][lane] = (hz * along - sin * lz) as f32;
        input[4][lane] = (cos_phi * ly - sin_phi * lx) as f32;
        input[5][lane] = (sin * along + hz * lz) as f32;
    }
}
