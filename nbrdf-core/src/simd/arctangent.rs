//! atan2 for vectors, of points above the x axis.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use pulp::Simd;

/// Angle \[rad\] of (x, y) with y ≥ 0 from the x axis, 0..π, within 3·10⁻⁷; 0 at the origin (S. Moshier, Cephes).
#[inline(always)]
pub(crate) fn angle<S: Simd>(simd: S, y: S::f32s, x: S::f32s) -> S::f32s {
    let constant = |value: f32| simd.splat_f32s(value);
    let [zero, one] = [0.0, 1.0].map(constant);
    let width = simd.abs_f32s(x);
    let (small, large) = (simd.min_f32s(width, y), simd.max_f32s(width, y));
    let t = simd.div_f32s(small, simd.max_f32s(large, constant(f32::MIN_POSITIVE)));
    // Beyond tan π/8, around π/4.
    let far = simd.greater_than_f32s(t, constant(0.414_213_56));
    let shifted = simd.div_f32s(simd.sub_f32s(t, one), simd.add_f32s(t, one));
    let (t, start) = (simd.select_f32s(far, shifted, t), simd.select_f32s(far, constant(FRAC_PI_4), zero));
    let square = simd.mul_f32s(t, t);
    let mut p = constant(8.053_744_5e-2);
    for coefficient in [-1.387_768_6e-1, 1.997_771_1e-1, -3.333_295e-1] {
        p = simd.mul_add_e_f32s(p, square, constant(coefficient));
    }
    let angle = simd.add_f32s(start, simd.mul_add_e_f32s(simd.mul_f32s(p, square), t, t));
    let angle = simd.select_f32s(simd.greater_than_f32s(y, width), simd.sub_f32s(constant(FRAC_PI_2), angle), angle);
    simd.select_f32s(simd.greater_than_f32s(zero, x), simd.sub_f32s(constant(PI), angle), angle)
}
