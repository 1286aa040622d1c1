//! A dense layer over a block of directions.
//!
//! Lanes are directions: a weight is broadcast to a whole vector, so that no shuffle is needed. A tile is up to six
//! outputs times two vectors of directions: twelve sums in registers hide the latency of the multiply-adds, and with two
//! inputs and a weight they fit the sixteen registers of AVX2.

use pulp::Simd;

use crate::simd::{LANES, Lanes};

/// Most outputs summed together.
const LARGEST_TILE: usize = 6;

/// Size of the next tile where so many outputs are left: as even as possible, since a tile of one or two outputs takes
/// hardly less time than one of four.
#[inline(always)]
const fn tile_size(left: usize) -> usize {
    left.div_ceil(left.div_ceil(LARGEST_TILE))
}

/// Vectors of directions summed together. The portable path has one number per vector and leaves it to the compiler to
/// put eight of them into registers.
#[inline(always)]
const fn vectors_per_tile<S: Simd>() -> usize {
    if S::F32_LANES == 1 { 8 } else { 2 }
}

/// Appends a layer in the order in which [`dense`] reads it: tile by tile of `outputs`, their biases, then for each of
/// `inputs` its weights to them.
pub(crate) fn pack(
    inputs: &[usize],
    outputs: &[usize],
    weight: impl Fn(usize, usize) -> f32,
    bias: impl Fn(usize) -> f32,
    packed: &mut Vec<f32>,
) {
    let mut outputs = outputs;
    while !outputs.is_empty() {
        let (tile, others) = outputs.split_at(tile_size(outputs.len()));
        packed.extend(tile.iter().map(|&output| bias(output)));
        for &input in inputs {
            packed.extend(tile.iter().map(|&output| weight(input, output)));
        }
        outputs = others;
    }
}

/// `out[j] = bias[j] + Σ_i input[i] · kernel[i][j]`, then relu if asked for; returns what follows the layer's weights.
#[inline(always)]
pub(crate) fn dense<'a, S: Simd, const RELU: bool>(
    simd: S,
    input: &[Lanes],
    mut weights: &'a [f32],
    out: &mut [Lanes],
) -> &'a [f32] {
    let mut out = out;
    while !out.is_empty() {
        let size = tile_size(out.len());
        let (own, others) = weights.split_at(size * (input.len() + 1));
        // Widths are known only at run time; every size of a tile is compiled once.
        match size {
            1 => tile::<S, 1, RELU>(simd, input, own, out),
            2 => tile::<S, 2, RELU>(simd, input, own, out),
            3 => tile::<S, 3, RELU>(simd, input, own, out),
            4 => tile::<S, 4, RELU>(simd, input, own, out),
            5 => tile::<S, 5, RELU>(simd, input, own, out),
            _ => tile::<S, LARGEST_TILE, RELU>(simd, input, own, out),
        }
        out = &mut out[size..];
        weights = others;
    }
    weights
}

/// `N` outputs for all directions of the block.
#[inline(always)]
fn tile<S: Simd, const N: usize, const RELU: bool>(simd: S, input: &[Lanes], weights: &[f32], out: &mut [Lanes]) {
    match vectors_per_tile::<S>() {
        8 => tile_of::<S, N, 8, RELU>(simd, input, weights, out),
        _ => tile_of::<S, N, 2, RELU>(simd, input, weights, out),
    }
}

#[inline(always)]
fn tile_of<S: Simd, const N: usize, const V: usize, const RELU: bool>(
    simd: S,
    input: &[Lanes],
    weights: &[f32],
    out: &mut [Lanes],
) {
    let [bias, kernel @ ..] = weights.as_chunks::<N>().0 else { return };
    let out: &mut [Lanes; N] = match out.first_chunk_mut() {
        Some(out) => out,
        None => return,
    };
    for group in 0..LANES / (V * S::F32_LANES) {
        let mut sums: [[S::f32s; V]; N] = std::array::from_fn(|j| [simd.splat_f32s(bias[j]); V]);
        for (x, row) in input.iter().zip(kernel) {
            let x = &x.vectors::<S>()[group * V..][..V];
            let x: [S::f32s; V] = std::array::from_fn(|v| x[v]);
            for (sum, &w) in sums.iter_mut().zip(row) {
                let w = simd.splat_f32s(w);
                for (sum, x) in sum.iter_mut().zip(x) {
                    *sum = simd.mul_add_e_f32s(w, x, *sum);
                }
            }
        }
        for (out, sum) in out.iter_mut().zip(sums) {
            let out = &mut out.vectors_mut::<S>()[group * V..][..V];
            for (out, sum) in out.iter_mut().zip(sum) {
                *out = if RELU { simd.max_f32s(sum, simd.splat_f32s(0.0)) } else { sum };
            }
        }
    }
}
