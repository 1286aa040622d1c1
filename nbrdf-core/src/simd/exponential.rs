//! `exp(y) − 1` for vectors, accurate near 0 and finite everywhere.

use pulp::Simd;

/// The result stays finite, whatever the weights.
const LARGEST_EXPONENT: f32 = 80.0;

/// exp(y) = 2ⁿ(1 + p) as 2ⁿ and p = exp(r) − 1, with |r| ≤ ½ ln 2 and Taylor to r⁷ (remainder 6·10⁻⁹ r).
#[inline(always)]
fn parts<S: Simd>(simd: S, y: S::f32s) -> (S::f32s, S::f32s) {
    const ROUND: f32 = 12_582_912.0; // 1.5 · 2²³: after adding it, the low bits are the nearest integer
    const LN2_HIGH: f32 = 0.693_359_4;
    const LN2_LOW: f32 = -2.121_944_4e-4;
    let constant = |value: f32| simd.splat_f32s(value);
    let y = simd.min_f32s(simd.max_f32s(y, constant(-LARGEST_EXPONENT)), constant(LARGEST_EXPONENT));
    let rounded = simd.mul_add_e_f32s(y, constant(std::f32::consts::LOG2_E), constant(ROUND));
    let n = simd.sub_f32s(rounded, constant(ROUND));
    let r = simd.mul_add_e_f32s(n, constant(-LN2_HIGH), y);
    let r = simd.mul_add_e_f32s(n, constant(-LN2_LOW), r);
    let mut p = constant(1.0 / 5040.0);
    for coefficient in [1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5] {
        p = simd.mul_add_e_f32s(p, r, constant(coefficient));
    }
    let p = simd.mul_add_e_f32s(simd.mul_f32s(p, r), r, r);
    let exponent = simd.add_u32s(simd.transmute_u32s_f32s(rounded), simd.splat_u32s(127));
    (simd.transmute_f32s_u32s(simd.wrapping_dyn_shl_u32s(exponent, simd.splat_u32s(23))), p)
}

/// `exp(y) − 1` within 2 ulp, as 2ⁿ p + (2ⁿ − 1).
///
/// y is taken into −80..80 first; NaN gives −1 or a finite number, never NaN.
#[inline(always)]
pub(crate) fn exp_minus_one<S: Simd>(simd: S, y: S::f32s) -> S::f32s {
    let (power, p) = parts(simd, y);
    simd.mul_add_e_f32s(power, p, simd.sub_f32s(power, simd.splat_f32s(1.0)))
}

/// `exp(y)` within 2 ulp; y is taken into −80..80 first.
#[inline(always)]
pub(crate) fn exp<S: Simd>(simd: S, y: S::f32s) -> S::f32s {
    let (power, p) = parts(simd, y);
    simd.mul_add_e_f32s(power, p, power)
}
