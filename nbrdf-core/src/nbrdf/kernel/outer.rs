//! Sums of products of activations and derivatives over directions: ∂loss/∂kernel and ∂loss/∂bias.

use pulp::Simd;

use crate::simd::{LANES, Lanes};

/// Partial sums per weight. The same for all vector sets, so that all give the same bits.
pub(crate) const PARTIAL: usize = 16;

/// Partial sums of one weight.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Partial([f32; PARTIAL]);

impl Partial {
    pub const ZERO: Self = Self([0.0; PARTIAL]);

    /// The whole sum: halves onto each other, always in the same order.
    pub fn sum(&self) -> f32 {
        let eight: [f32; 8] = std::array::from_fn(|i| self.0[i] + self.0[i + 8]);
        let four: [f32; 4] = std::array::from_fn(|i| eight[i] + eight[i + 4]);
        (four[0] + four[2]) + (four[1] + four[3])
    }
}

/// Adds to a layer's `sums`, its kernel (`inputs` × `width`, row-major) and then its bias, the sums of
/// `input[i] · by_output[j]` and of `by_output[j]` over all directions of a few blocks, given as one list of rows each.
///
/// A tile of the kernel stays in registers over all blocks before it is added to memory: 3 × 7 where there are 32 long
/// registers, else 2 × 3.
#[inline(always)]
pub(crate) fn accumulate<S: Simd>(
    simd: S,
    inputs: &[&[Lanes]],
    by_outputs: &[&[Lanes]],
    width: usize,
    sums: &mut [Partial],
) {
    let (kernel, bias) = sums.split_at_mut(sums.len() - width);
    let rows = kernel.len() / width;
    let step = if S::F32_LANES >= PARTIAL { 3 } else { 2 };
    for first in (0..rows).step_by(step) {
        let kernel = &mut kernel[first * width..];
        match (step, rows - first) {
            (3, 3..) => columns::<S, 3, 7>(simd, inputs, by_outputs, first, width, kernel),
            (3, 2) => columns::<S, 2, 7>(simd, inputs, by_outputs, first, width, kernel),
            (3, _) => columns::<S, 1, 7>(simd, inputs, by_outputs, first, width, kernel),
            (_, 2..) => columns::<S, 2, 3>(simd, inputs, by_outputs, first, width, kernel),
            _ => columns::<S, 1, 3>(simd, inputs, by_outputs, first, width, kernel),
        }
    }
    for (j, sum) in bias.iter_mut().enumerate() {
        let sum = S::as_mut_simd_f32s(&mut sum.0).0;
        for by_output in by_outputs {
            let (low, high) = by_output[j].vectors::<S>().split_at(sum.len());
            for v in 0..sum.len() {
                sum[v] = simd.add_f32s(sum[v], simd.add_f32s(low[v], high[v]));
            }
        }
    }
}

/// `I` rows of the kernel, `J` columns at a time.
#[inline(always)]
fn columns<S: Simd, const I: usize, const J: usize>(
    simd: S,
    inputs: &[&[Lanes]],
    by_outputs: &[&[Lanes]],
    row: usize,
    width: usize,
    kernel: &mut [Partial],
) {
    let mut column = 0;
    while column < width {
        let (at, stride) = ([row, column], width);
        let kernel = &mut kernel[column..];
        column += match width - column {
            rest if rest >= J => tile::<S, I, J>(simd, inputs, by_outputs, at, stride, kernel),
            // At most seven columns, so at most two of these.
            rest if rest >= 3 => tile::<S, I, 3>(simd, inputs, by_outputs, at, stride, kernel),
            2 => tile::<S, I, 2>(simd, inputs, by_outputs, at, stride, kernel),
            _ => tile::<S, I, 1>(simd, inputs, by_outputs, at, stride, kernel),
        };
    }
}

/// Returns the columns done, `J`.
#[inline(always)]
fn tile<S: Simd, const I: usize, const J: usize>(
    simd: S,
    inputs: &[&[Lanes]],
    by_outputs: &[&[Lanes]],
    at: [usize; 2],
    stride: usize,
    kernel: &mut [Partial],
) -> usize {
    match PARTIAL / S::F32_LANES {
        1 => tile_of::<S, I, J, 1>(simd, inputs, by_outputs, at, stride, kernel),
        2 => tile_of::<S, I, J, 2>(simd, inputs, by_outputs, at, stride, kernel),
        4 => tile_of::<S, I, J, 4>(simd, inputs, by_outputs, at, stride, kernel),
        _ => tile_of::<S, I, J, PARTIAL>(simd, inputs, by_outputs, at, stride, kernel),
    }
    J
}

/// `I` inputs × `J` outputs, whose partial sums are `V` vectors each.
#[inline(always)]
fn tile_of<S: Simd, const I: usize, const J: usize, const V: usize>(
    simd: S,
    inputs: &[&[Lanes]],
    by_outputs: &[&[Lanes]],
    [row, column]: [usize; 2],
    stride: usize,
    kernel: &mut [Partial],
) {
    let mut sums = [[[simd.splat_f32s(0.0); J]; I]; V];
    for (input, by_output) in inputs.iter().zip(by_outputs) {
        let (input, by_output) = (&input[row..row + I], &by_output[column..column + J]);
        for half in 0..LANES / PARTIAL {
            for (v, sums) in sums.iter_mut().enumerate() {
                let at = half * V + v;
                let d: [S::f32s; J] = std::array::from_fn(|j| by_output[j].vectors::<S>()[at]);
                for (sums, input) in sums.iter_mut().zip(input) {
                    let x = input.vectors::<S>()[at];
                    for (sum, d) in sums.iter_mut().zip(d) {
                        *sum = simd.mul_add_e_f32s(x, d, *sum);
                    }
                }
            }
        }
    }
    for (v, sums) in sums.into_iter().enumerate() {
        for (i, sums) in sums.into_iter().enumerate() {
            for (sum, partial) in sums.into_iter().zip(&mut kernel[i * stride..]) {
                let partial = &mut S::as_mut_simd_f32s(&mut partial.0).0[v];
                *partial = simd.add_f32s(*partial, sum);
            }
        }
    }
}
