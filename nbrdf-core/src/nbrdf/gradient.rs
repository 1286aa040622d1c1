//! Gradient of any loss on reflectance values with respect to the weights, by hand-written back-propagation.
//!
//! Fitting a network, refining a code and training the autoencoder all stand on this one pass.

use pulp::{Arch, Simd, WithSimd};

use super::kernel::{Activations, LANES, Lanes, Weights, load, vectors};
use super::{INPUTS, Layout, weight_count};
use crate::{HalfDiff, Rgb};

/// Partial sums per weight: half a block, so that all of them stay in the first-level cache.
const PARTIAL: usize = LANES / 2;

/// Evaluates a network and back-propagates; reusable, so that a fit allocates nothing per step.
pub struct Backpropagation {
    hidden: [usize; 2],
    blocks: Vec<Activations>,
    partial: Vec<[f32; PARTIAL]>,
}

impl Backpropagation {
    /// For networks of these hidden widths.
    pub fn new(hidden: [usize; 2]) -> Self {
        Self { hidden, blocks: Vec::new(), partial: vec![[0.0; PARTIAL]; weight_count(hidden)] }
    }

    /// f_r before the clamp at zero, for every pair of directions; keeps what [`backward`](Self::backward) needs.
    ///
    /// # Panics
    /// If the lengths of `weights` or `out` do not fit (a bug of the caller).
    pub fn forward(&mut self, weights: &[f32], at: &[HalfDiff], out: &mut [Rgb]) {
        assert_eq!(weights.len(), weight_count(self.hidden), "weights of this shape");
        assert_eq!(at.len(), out.len(), "one output per pair of directions");
        let hidden = self.hidden;
        self.blocks.resize_with(at.len().div_ceil(LANES), || Activations::new(hidden));
        let net = Weights { hidden, flat: weights };
        Arch::new().dispatch(Forward { net, at, out, blocks: &mut self.blocks });
    }

    /// ∂loss/∂weights from ∂loss/∂f at the directions of the last [`forward`](Self::forward), written to `gradient`.
    ///
    /// # Panics
    /// If the lengths do not fit (a bug of the caller).
    pub fn backward(&mut self, weights: &[f32], loss_by_value: &[Rgb], gradient: &mut [f32]) {
        assert_eq!(weights.len(), gradient.len(), "one derivative per weight");
        assert_eq!(self.blocks.len(), loss_by_value.len().div_ceil(LANES), "as many values as directions");
        let net = Weights { hidden: self.hidden, flat: weights };
        self.partial.fill([0.0; PARTIAL]);
        Arch::new().dispatch(Backward { net, loss_by_value, blocks: &self.blocks, partial: &mut self.partial });
        for (sum, partial) in gradient.iter_mut().zip(&self.partial) {
            *sum = partial.iter().sum();
        }
    }
}

struct Forward<'a> {
    net: Weights<'a>,
    at: &'a [HalfDiff],
    out: &'a mut [Rgb],
    blocks: &'a mut [Activations],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for ((at, out), block) in self.at.chunks(LANES).zip(self.out.chunks_mut(LANES)).zip(self.blocks) {
            load(at, &mut block.input);
            block.forward(simd, self.net);
            for (lane, out) in out.iter_mut().enumerate() {
                *out = Rgb(block.output.map(|y| y[lane]));
            }
        }
    }
}

struct Backward<'a> {
    net: Weights<'a>,
    loss_by_value: &'a [Rgb],
    blocks: &'a [Activations],
    partial: &'a mut [[f32; PARTIAL]],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [(k1, b1), (k2, b2), (k3, b3)] = Layout::new(self.net.hidden).layers;
        let w = self.net.flat;
        let zero = [0.0; LANES];
        let (mut by_first, mut by_second) = (vec![zero; self.net.hidden[0]], vec![zero; self.net.hidden[1]]);
        for (block, loss_by_value) in self.blocks.iter().zip(self.loss_by_value.chunks(LANES)) {
            let mut by_output = [zero; 3];
            for (lane, value) in loss_by_value.iter().enumerate() {
                for channel in 0..3 {
                    // d(exp(y) − 1)/dy = f + 1
                    by_output[channel][lane] = value[channel] * (block.output[channel][lane] + 1.0);
                }
            }
            accumulate(simd, &block.second, &by_output, self.partial, k3.start, b3.start);
            transposed(simd, &by_output, &w[k3.clone()], &block.second, &mut by_second);
            accumulate(simd, &block.first, &by_second, self.partial, k2.start, b2.start);
            transposed(simd, &by_second, &w[k2.clone()], &block.first, &mut by_first);
            accumulate(simd, &block.input, &by_first, self.partial, k1.start, b1.start);
        }
        debug_assert_eq!(k1.len(), INPUTS * self.net.hidden[0]);
    }
}

/// ∂loss/∂input through a dense layer and the relu before it.
#[inline(always)]
fn transposed<S: Simd>(simd: S, by_output: &[Lanes], kernel: &[f32], input: &[Lanes], by_input: &mut [Lanes]) {
    for ((row, input), by_input) in kernel.chunks_exact(by_output.len()).zip(input).zip(by_input) {
        let (input, by_input) = (vectors::<S>(input), S::as_mut_simd_f32s(by_input).0);
        for pair in 0..LANES / (2 * S::F32_LANES) {
            let (low, high) = (2 * pair, 2 * pair + 1);
            let mut sums = [simd.splat_f32s(0.0); 2];
            for (&w, by_output) in row.iter().zip(by_output) {
                let (w, by_output) = (simd.splat_f32s(w), vectors::<S>(by_output));
                sums[0] = simd.mul_add_e_f32s(w, by_output[low], sums[0]);
                sums[1] = simd.mul_add_e_f32s(w, by_output[high], sums[1]);
            }
            for (at, sum) in [low, high].into_iter().zip(sums) {
                let zero = simd.splat_f32s(0.0);
                by_input[at] = simd.select_f32s(simd.greater_than_f32s(input[at], zero), sum, zero);
            }
        }
    }
}

/// Adds one block's share of ∂loss/∂kernel and ∂loss/∂bias; vectors of a block fold onto the partial sums.
#[inline(always)]
fn accumulate<S: Simd>(
    simd: S,
    input: &[Lanes],
    by_output: &[Lanes],
    partial: &mut [[f32; PARTIAL]],
    kernel: usize,
    bias: usize,
) {
    let width = by_output.len();
    for (x, row) in input.iter().zip(partial[kernel..].chunks_exact_mut(width)) {
        let (low, high) = vectors::<S>(x).split_at(PARTIAL / S::F32_LANES);
        for (sum, d) in row.iter_mut().zip(by_output) {
            let d = vectors::<S>(d).split_at(PARTIAL / S::F32_LANES);
            for (at, sum) in S::as_mut_simd_f32s(sum).0.iter_mut().enumerate() {
                *sum = simd.mul_add_e_f32s(high[at], d.1[at], simd.mul_add_e_f32s(low[at], d.0[at], *sum));
            }
        }
    }
    for (sum, d) in partial[bias..].iter_mut().zip(by_output) {
        for lane in 0..PARTIAL {
            sum[lane] += d[lane] + d[lane + PARTIAL];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nbrdf::fit::{generator, random_network};
    use crate::nbrdf::kernel::forward_plainly;
    use crate::nbrdf::objective::{Objective, features, features_into, pull_back};
    use crate::nbrdf::samples::{SampleCounts, Samples};
    use crate::{Brdf, Nbrdf};

    fn samples() -> Samples {
        // 37 + 50 + 4 · 9 directions: the last block is not full.
        Samples::random(&mut generator(3, 0), SampleCounts { log: 37, relative: 50, pixels: 9, lamps: 4 })
    }

    fn loss(network: &Nbrdf, samples: &Samples, wanted: &[f32]) -> f64 {
        let mut values = vec![Rgb::BLACK; samples.inputs.len()];
        let mut pass = Backpropagation::new(network.hidden());
        pass.forward(network.weights(), &samples.inputs, &mut values);
        let own = features(samples, &values);
        Objective::FIT.loss(samples, &own, wanted, &mut vec![0.0; own.len()])
    }

    #[test]
    fn forward_agrees_with_the_plain_loop_in_f64() {
        let (network, samples) = (random_network(1, 0), samples());
        let mut values = vec![Rgb::BLACK; samples.inputs.len()];
        Backpropagation::new(network.hidden()).forward(network.weights(), &samples.inputs, &mut values);
        for (at, value) in samples.inputs.iter().zip(&values) {
            for (own, plain) in value.0.into_iter().zip(forward_plainly(&network, *at)) {
                assert!((f64::from(own) - plain).abs() <= 2e-6 * (1.0 + plain.abs()), "{own} {plain}");
            }
        }
        let mut evaluated = vec![Rgb::BLACK; values.len()];
        network.eval_signed_into(&samples.directions, &mut evaluated);
        for (a, b) in values.iter().zip(&evaluated) {
            assert!(a.zip(*b, |a, b| (a - b).abs()).max() < 1e-5);
        }
    }

    #[test]
    fn gradient_agrees_with_finite_differences() {
        let (network, target, samples) = (random_network(1, 0), random_network(2, 0), samples());
        let wanted = features(&samples, &samples.values(&target));
        let mut values = vec![Rgb::BLACK; samples.inputs.len()];
        let mut pass = Backpropagation::new(network.hidden());
        pass.forward(network.weights(), &samples.inputs, &mut values);
        let mut own = vec![0.0; wanted.len()];
        features_into(&samples, &values, &mut own);
        let mut by_feature = vec![0.0; own.len()];
        Objective::FIT.loss(&samples, &own, &wanted, &mut by_feature);
        let mut by_value = vec![Rgb::BLACK; values.len()];
        pull_back(&samples, &values, &own, &by_feature, &mut by_value);
        let mut gradient = vec![0.0; network.weights().len()];
        pass.backward(network.weights(), &by_value, &mut gradient);
        let largest = gradient.iter().fold(0.0f32, |max, g| max.max(g.abs()));
        // The loss has kinks (relu, absolute values), so a few weights may disagree; a wrong term would disagree in many.
        let mut wrong = 0;
        for index in (0..gradient.len()).step_by(7) {
            let nudged = |by: f32| {
                let mut weights = network.weights().to_vec();
                weights[index] += by;
                loss(&Nbrdf::published(weights).unwrap(), &samples, &wanted)
            };
            let slope = ((nudged(1e-3) - nudged(-1e-3)) / 2e-3) as f32;
            wrong += usize::from((slope - gradient[index]).abs() > 0.02 * largest);
        }
        assert!(wrong <= 3, "{wrong} of 97 derivatives are off");
    }
}
