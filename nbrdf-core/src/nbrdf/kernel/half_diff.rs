//! Half and difference vectors of a block, without trigonometry; the same function as [`Directions::half_diff`].
//!
//! In f32, yet as accurate as rounding: with s = l + v and c = v × l, every component is a product or quotient of
//! numbers of small *relative* error, so that nothing cancels near the normal, where glossy networks are steep:
//!
//! h = (|s_xy|, 0, s_z) / |s|, d = ((s_x c_y − s_y c_x) / (|s_xy| |s|), c_z / |s_xy|, |s · l| / |s|).

use pulp::Simd;

use super::INPUTS;
use crate::Directions;
use crate::brdf::Azimuth;
use crate::brdf::pairs::{Pairs, above, where_above};
use crate::direction::OPPOSITE;
use crate::simd::{LANES, Lanes};

/// Square of the least sum across the normal that has an azimuth.
const TILTED: f32 = 1e-30;

/// One block of pairs as network inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// h.x h.z d.x d.y d.z h.y: what isotropic networks need not read comes last, 0 unless the azimuth is kept.
    pub inputs: [Lanes; INPUTS],
    /// Bit `lane` is set where both directions are above the surface.
    pub above: u32,
}

impl Block {
    pub const EMPTY: Self = Self { inputs: [Lanes::ZERO; INPUTS], above: 0 };

    /// Fills the block from 1 to [`LANES`] pairs; unused lanes repeat the last one, and are not above.
    #[inline(always)]
    pub fn fill<S: Simd>(&mut self, simd: S, pairs: &[Directions], azimuth: Azimuth) {
        let loaded = Pairs::load(pairs);
        let [h0, h2, d0, d1, d2, h1] = &mut self.inputs;
        let mut valid = simd.splat_f32s(1.0);
        for i in 0..LANES / S::F32_LANES {
            let [light, view] = loaded.vectors::<S>(i);
            valid = where_above(simd, light[2], view[2], valid);
            let [hx, hz, dx, dy, dz] = half_diff(simd, light, view);
            let [hx, hy] = match azimuth {
                Azimuth::Dropped => [hx, simd.splat_f32s(0.0)],
                Azimuth::Kept => turned(simd, hx, light, view),
            };
            h0.vectors_mut::<S>()[i] = hx;
            h1.vectors_mut::<S>()[i] = hy;
            h2.vectors_mut::<S>()[i] = hz;
            d0.vectors_mut::<S>()[i] = dx;
            d1.vectors_mut::<S>()[i] = dy;
            d2.vectors_mut::<S>()[i] = dz;
        }
        let whole = pairs.len() == LANES && simd.reduce_min_f32s(valid) > 0.0;
        self.above = if whole { u32::MAX } else { above(pairs) };
    }
}

/// h.x and h.y as they are, from sin θ_half; azimuth 0 where [`half_diff`] takes it so.
#[inline(always)]
fn turned<S: Simd>(simd: S, sin: S::f32s, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 2] {
    let [sx, sy] = [0, 1].map(|axis| simd.add_f32s(light[axis], view[axis]));
    let across2 = simd.mul_add_e_f32s(sx, sx, simd.mul_f32s(sy, sy));
    let scale = simd.div_f32s(sin, simd.sqrt_f32s(across2));
    let tilted = simd.greater_than_f32s(across2, simd.splat_f32s(TILTED));
    let or = |then, otherwise| simd.select_f32s(tilted, then, otherwise);
    [or(simd.mul_f32s(sx, scale), sin), or(simd.mul_f32s(sy, scale), simd.splat_f32s(0.0))]
}

/// h.x, h.z, d.x, d.y, d.z; h.y is 0. For vectors of lengths within 10⁻⁶ of 1, h and d are unit vectors as closely, and
/// neither points down.
#[inline(always)]
pub(crate) fn half_diff<S: Simd>(simd: S, [lx, ly, lz]: [S::f32s; 3], [vx, vy, vz]: [S::f32s; 3]) -> [S::f32s; 5] {
    let mul = |a, b| simd.mul_f32s(a, b);
    let fma = |a, b, c| simd.mul_add_e_f32s(a, b, c);
    // a b − c d with the rounding error of c d put back (W. Kahan; Jeannerod, Louvet, Muller 2013, algorithm 1). Single
    // numbers have no fused multiply-add that could find that error; in f64 their products are exact.
    let difference = |a, b, c, d| {
        if S::F32_LANES == 1 {
            let [a, b, c, d] = [a, b, c, d].map(|v| f64::from(simd.reduce_sum_f32s(v)));
            return simd.splat_f32s((a * b - c * d) as f32);
        }
        let cd = mul(c, d);
        let lost = simd.negate_mul_add_e_f32s(c, d, cd);
        simd.add_f32s(fma(a, b, simd.neg_f32s(cd)), lost)
    };
    let [sx, sy, sz] = [simd.add_f32s(lx, vx), simd.add_f32s(ly, vy), simd.add_f32s(lz, vz)];
    // So close to opposite that the sum is mostly rounding: h is taken as the normal, in the middle between them.
    let one = simd.splat_f32s(1.0);
    let zero = simd.splat_f32s(0.0);
    let square = fma(sz, sz, fma(sx, sx, mul(sy, sy)));
    let is_opposite = simd.less_than_f32s(square, simd.splat_f32s(OPPOSITE * OPPOSITE));
    let or = |then, otherwise| simd.select_f32s(is_opposite, then, otherwise);
    let [sx, sy, sz] = [or(zero, sx), or(zero, sy), or(one, sz)];
    let across2 = fma(sx, sx, mul(sy, sy));
    let across = simd.sqrt_f32s(across2);
    let inverse = simd.div_f32s(one, simd.sqrt_f32s(fma(sz, sz, across2)));
    let inverse_across = simd.div_f32s(one, across);
    let cx = difference(vy, lz, vz, ly);
    let cy = difference(vz, lx, vx, lz);
    let cz = difference(vx, ly, vy, lx);
    let dx = mul(mul(difference(sx, cy, sy, cx), inverse_across), inverse);
    let dy = mul(cz, inverse_across);
    // Below 0 only where the lengths are not quite 1.
    let dz = mul(simd.abs_f32s(fma(sz, lz, fma(sx, lx, mul(sy, ly)))), inverse);
    // At the normal the azimuth of h is taken as 0. This close to it, l and v are so close that any azimuth would do.
    let tilted = simd.greater_than_f32s(across2, simd.splat_f32s(TILTED));
    let (dx, dy) = (simd.select_f32s(tilted, dx, lx), simd.select_f32s(tilted, dy, ly));
    [mul(across, inverse), mul(sz, inverse), dx, dy, dz]
}

/// The network input that each of a block's inputs is.
pub(crate) const ORDER: [usize; INPUTS] = [0, 2, 3, 4, 5, 1];
