//! Vectors of the processor: blocks of numbers, elementary functions over them, and which instructions to use.
//!
//! `pulp` compiles every loop once for each instruction set; one binary runs everywhere, without `unsafe`.

mod arctangent;
mod exponential;
mod instruction_set;
mod lanes;
mod logarithm;

use pulp::{Simd, WithSimd};

pub(crate) use arctangent::angle;
pub(crate) use exponential::{exp, exp_minus_one};
pub use instruction_set::{InstructionSet, VARIABLE};
pub(crate) use lanes::{LANES, Lanes};
pub(crate) use logarithm::ln;

/// ln of every number, in place; numbers below 10⁻³⁷ count as that.
pub fn logarithms(values: &mut [f32]) {
    each(values, Logarithm);
}

/// Every number to the power `exponent`, in place; 0 and what is below it give 0. Relative error below 2·10⁻⁶ for
/// numbers of 10⁻⁶ to 10⁶ and exponents in 0..1.
pub fn powers(values: &mut [f32], exponent: f32) {
    each(values, Power(exponent));
}

/// A function of one number.
trait Function: Copy {
    fn of<S: Simd>(self, simd: S, x: S::f32s) -> S::f32s;
}

#[derive(Clone, Copy)]
struct Logarithm;

impl Function for Logarithm {
    #[inline(always)]
    fn of<S: Simd>(self, simd: S, x: S::f32s) -> S::f32s {
        ln(simd, x)
    }
}

#[derive(Clone, Copy)]
struct Power(f32);

impl Function for Power {
    #[inline(always)]
    fn of<S: Simd>(self, simd: S, x: S::f32s) -> S::f32s {
        let [zero, exponent] = [0.0, self.0].map(|v| simd.splat_f32s(v));
        let power = exp(simd, simd.mul_f32s(exponent, ln(simd, x)));
        simd.select_f32s(simd.greater_than_f32s(x, zero), power, zero)
    }
}

fn each(values: &mut [f32], function: impl Function) {
    struct Each<'a, F>(&'a mut [f32], F);

    impl<F: Function> WithSimd for Each<'_, F> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            let (whole, rest) = S::as_mut_simd_f32s(self.0);
            for x in whole {
                *x = self.1.of(simd, *x);
            }
            let last = self.1.of(simd, simd.partial_load_f32s(rest));
            simd.partial_store_f32s(rest, last);
        }
    }

    InstructionSet::fastest().run(Each(values, function));
}

#[cfg(test)]
mod tests;
