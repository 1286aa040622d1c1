//! Forward pass over blocks of directions, vectorized by the compiler for the widest instruction set at hand.
//!
//! Lanes are directions: one weight is broadcast to a whole block, so that no shuffle is needed. `pulp` picks the
//! instruction set at run time and keeps this file free of `unsafe`.

mod exponential;
mod input;

use pulp::{Arch, Simd, WithSimd};

use super::{INPUTS, Layout, Nbrdf};
use crate::{Directions, Rgb};
use exponential::exp_minus_one;
use input::convert;
pub(crate) use input::load;

/// Directions per block.
pub(crate) const LANES: usize = 16;
/// One number for each direction of a block.
pub(crate) type Lanes = [f32; LANES];
/// Outputs computed together, so that one load of the inputs serves several sums.
const TILE: usize = 3;

/// A network as the loops want it: weights and where they lie.
#[derive(Clone, Copy)]
pub(crate) struct Weights<'a> {
    pub hidden: [usize; 2],
    pub flat: &'a [f32],
}

/// The activations of one block.
pub(crate) struct Activations {
    pub input: [Lanes; INPUTS],
    pub first: Vec<Lanes>,
    pub second: Vec<Lanes>,
    /// exp(y) − 1, not clamped.
    pub output: [Lanes; 3],
}

impl Activations {
    pub fn new([first, second]: [usize; 2]) -> Self {
        let zero = [0.0; LANES];
        Self { input: [zero; INPUTS], first: vec![zero; first], second: vec![zero; second], output: [zero; 3] }
    }

    /// Fills `output` from `input`.
    #[inline(always)]
    pub fn forward<S: Simd>(&mut self, simd: S, net: Weights) {
        let [(k1, b1), (k2, b2), (k3, b3)] = Layout::new(net.hidden).layers;
        let w = net.flat;
        dense::<S, true>(simd, &self.input, &w[k1], &w[b1], &mut self.first);
        dense::<S, true>(simd, &self.first, &w[k2], &w[b2], &mut self.second);
        dense::<S, false>(simd, &self.second, &w[k3], &w[b3], &mut self.output);
        for y in &mut self.output {
            for y in y {
                *y = exp_minus_one::<S>(*y);
            }
        }
    }
}

/// A block as vectors of the processor.
#[inline(always)]
pub(crate) fn vectors<S: Simd>(lanes: &Lanes) -> &[S::f32s] {
    S::as_simd_f32s(lanes).0
}

/// `out[j] = bias[j] + Σ_i input[i] · kernel[i][j]`, then relu if asked for.
///
/// Two vectors of directions times three outputs are summed at once: six sums, two inputs and a weight fit the
/// sixteen registers of AVX2.
#[inline(always)]
fn dense<S: Simd, const RELU: bool>(simd: S, input: &[Lanes], kernel: &[f32], bias: &[f32], out: &mut [Lanes]) {
    let width = out.len();
    let whole = width - width % TILE;
    for pair in 0..LANES / (2 * S::F32_LANES) {
        for start in (0..whole).step_by(TILE) {
            tile::<S, TILE, RELU>(simd, input, &kernel[start..], &bias[start..], &mut out[start..], width, pair);
        }
        for start in whole..width {
            tile::<S, 1, RELU>(simd, input, &kernel[start..], &bias[start..], &mut out[start..], width, pair);
        }
    }
}

/// `N` outputs for the two vectors `2 pair` and `2 pair + 1` of the block.
#[inline(always)]
fn tile<S: Simd, const N: usize, const RELU: bool>(
    simd: S,
    input: &[Lanes],
    kernel: &[f32],
    bias: &[f32],
    out: &mut [Lanes],
    width: usize,
    pair: usize,
) {
    let mut sums = [[simd.splat_f32s(0.0); 2]; N];
    for (sum, &bias) in sums.iter_mut().zip(bias) {
        *sum = [simd.splat_f32s(bias); 2];
    }
    for (x, row) in input.iter().zip(kernel.chunks(width)) {
        let x = vectors::<S>(x);
        let (low, high) = (x[2 * pair], x[2 * pair + 1]);
        for (sum, &w) in sums.iter_mut().zip(&row[..N]) {
            let w = simd.splat_f32s(w);
            sum[0] = simd.mul_add_e_f32s(w, low, sum[0]);
            sum[1] = simd.mul_add_e_f32s(w, high, sum[1]);
        }
    }
    for (out, sum) in out.iter_mut().zip(sums) {
        let out = S::as_mut_simd_f32s(out).0;
        for (half, sum) in sum.into_iter().enumerate() {
            out[2 * pair + half] = if RELU { simd.max_f32s(sum, simd.splat_f32s(0.0)) } else { sum };
        }
    }
}

struct Evaluate<'a> {
    net: Weights<'a>,
    at: &'a [Directions],
    out: &'a mut [Rgb],
}

impl WithSimd for Evaluate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut activations = Activations::new(self.net.hidden);
        for (at, out) in self.at.chunks(LANES).zip(self.out.chunks_mut(LANES)) {
            convert(at, &mut activations.input);
            activations.forward(simd, self.net);
            for (lane, (at, out)) in at.iter().zip(out).enumerate() {
                *out = if at.is_above() { Rgb(activations.output.map(|y| y[lane])) } else { Rgb::BLACK };
            }
        }
    }
}

/// exp(y) − 1, not clamped, for every pair of directions; zero below the horizon.
pub(super) fn forward(network: &Nbrdf, at: &[Directions], out: &mut [Rgb]) {
    assert_eq!(at.len(), out.len(), "one output per pair of directions");
    let net = Weights { hidden: network.hidden, flat: &network.weights };
    Arch::new().dispatch(Evaluate { net, at, out });
}

/// The slow, obvious loop in f64 that the kernel is tested against.
#[cfg(test)]
pub(crate) fn forward_plainly(network: &Nbrdf, crate::HalfDiff { half, diff }: crate::HalfDiff) -> [f64; 3] {
    let layers = network.layout().layers;
    let crate::Vec3 { x, y, z } = half;
    let mut values = [x, y, z, diff.x, diff.y, diff.z].map(f64::from).to_vec();
    for (index, (kernel, bias)) in layers.into_iter().enumerate() {
        let (kernel, bias) = (&network.weights[kernel], &network.weights[bias]);
        let sum = |j: usize| -> f64 {
            values.iter().enumerate().map(|(i, v)| v * f64::from(kernel[i * bias.len() + j])).sum::<f64>()
        };
        values = (0..bias.len()).map(|j| f64::from(bias[j]) + sum(j)).collect();
        if index < 2 {
            values.iter_mut().for_each(|v| *v = v.max(0.0));
        }
    }
    std::array::from_fn(|channel| values[channel].exp_m1())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Brdf, Vec3};

    #[test]
    fn directions_below_the_horizon_and_nan_give_black() {
        let network = crate::nbrdf::fit::random_network(0, 0);
        let below = Directions::new(Vec3::new(0.6, 0.0, -0.8), Vec3::Z);
        let nan = Directions::new(Vec3::new(f32::NAN, 0.0, f32::NAN), Vec3::Z);
        assert_eq!(network.eval(below), Rgb::BLACK);
        assert_eq!(network.eval(nan), Rgb::BLACK);
    }
}
