//! `exp(y) − 1` for whole blocks, without a call per number.

use pulp::Simd;

/// The result stays finite, whatever the weights.
const LARGEST_EXPONENT: f32 = 80.0;

/// `a b + c`, fused where the processor can: on the others `mul_add` is a slow library call.
#[inline(always)]
fn multiply_add<S: Simd>(a: f32, b: f32, c: f32) -> f32 {
    if S::F32_LANES > 1 { a.mul_add(b, c) } else { a * b + c }
}

/// `exp(y) − 1` without losing digits near 0: 2ⁿ(exp(r) − 1) + (2ⁿ − 1) with |r| ≤ ½ ln 2, Taylor to r⁷.
#[inline(always)]
pub(super) fn exp_minus_one<S: Simd>(y: f32) -> f32 {
    const ROUND: f32 = 12_582_912.0; // 1.5 · 2²³: after adding it, the low bits are the nearest integer
    const LN2_HIGH: f32 = 0.693_359_4;
    const LN2_LOW: f32 = -2.121_944_4e-4;
    let y = y.clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT);
    let rounded = multiply_add::<S>(y, std::f32::consts::LOG2_E, ROUND);
    let n = rounded - ROUND;
    let r = multiply_add::<S>(-n, LN2_LOW, multiply_add::<S>(-n, LN2_HIGH, y));
    let mut p = 1.0 / 5040.0;
    for c in [1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5] {
        p = multiply_add::<S>(p, r, c);
    }
    let p = multiply_add::<S>(p * r, r, r);
    let power = f32::from_bits((rounded.to_bits() << 23).wrapping_add(127 << 23));
    multiply_add::<S>(power, p, power - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exp_minus_one_keeps_its_digits_near_zero_and_stays_finite() {
        for y in [-50.0, -3.0, -0.4, -1e-3, -1e-6, 0.0, 1e-7, 2e-4, 0.3, 1.0, 7.0, 40.0] {
            let exact = f64::from(y).exp_m1();
            let error = (f64::from(exp_minus_one::<pulp::Scalar>(y)) - exact).abs();
            assert!(error <= 3e-7 * exact.abs(), "{y}: {error:e} of {exact:e}");
        }
        assert!(exp_minus_one::<pulp::Scalar>(1e30).is_finite());
    }
}
