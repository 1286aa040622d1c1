//! ln for vectors.

use pulp::Simd;

/// Smaller numbers are taken as this: every number has a finite logarithm.
const SMALLEST: f32 = 1e-37;

/// ln x within 2 ulp (absolutely 10⁻⁷ near 1): x = 2ᵉ m with m in √½..√2, and a polynomial of m − 1 (S. Moshier, Cephes).
#[inline(always)]
pub(crate) fn ln<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    const ROOT_HALF: u32 = 0x3f35_04f3;
    const ONE: u32 = 0x3f80_0000;
    /// 2²³ as bits: a small integer put below it is a number, whose value is 2²³ more.
    const MAGIC: u32 = 0x4b00_0000;
    let constant = |value: f32| simd.splat_f32s(value);
    let bits = simd.transmute_u32s_f32s(simd.max_f32s(x, constant(SMALLEST)));
    let shifted = simd.add_u32s(bits, simd.splat_u32s(ONE - ROOT_HALF));
    let exponent = simd.wrapping_dyn_shr_u32s(shifted, simd.splat_u32s(23));
    let exponent = simd.transmute_f32s_u32s(simd.or_u32s(exponent, simd.splat_u32s(MAGIC)));
    let exponent = simd.sub_f32s(exponent, constant(8_388_608.0 + 127.0));
    let mantissa = simd.and_u32s(shifted, simd.splat_u32s(0x007f_ffff));
    let mantissa = simd.transmute_f32s_u32s(simd.add_u32s(mantissa, simd.splat_u32s(ROOT_HALF)));
    let t = simd.sub_f32s(mantissa, constant(1.0));
    let square = simd.mul_f32s(t, t);
    let mut p = constant(7.037_683_6e-2);
    for coefficient in [
        -1.151_461e-1,
        1.167_699_9e-1,
        -1.242_014_1e-1,
        1.424_932_3e-1,
        -1.666_805_8e-1,
        2.000_071_5e-1,
        -2.499_999_4e-1,
        3.333_333e-1,
    ] {
        p = simd.mul_add_e_f32s(p, t, constant(coefficient));
    }
    let p = simd.mul_f32s(simd.mul_f32s(p, t), square);
    let p = simd.mul_add_e_f32s(exponent, constant(-2.121_944_4e-4), p);
    let p = simd.mul_add_e_f32s(square, constant(-0.5), p);
    simd.mul_add_e_f32s(exponent, constant(0.693_359_4), simd.add_f32s(t, p))
}
