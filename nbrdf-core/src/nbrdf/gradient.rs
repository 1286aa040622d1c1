//! Gradient of any loss on reflectance values with respect to the weights, by hand-written back-propagation.
//!
//! Fitting a network and training the autoencoder stand on this one pass.

use pulp::{Simd, WithSimd};

use super::kernel::dense::{dense, pack};
use super::kernel::outer::{Partial, accumulate};
use super::kernel::{Activations, Block, Live, ORDER, Packed};
use super::tangent::stop_where_silent;
use super::{INPUTS, Layout, weight_count};
use crate::Rgb;
use crate::brdf::Prepared;
use crate::simd::{InstructionSet, LANES, Lanes};

/// Blocks back-propagated together: their derivatives stay in the first-level cache.
const GROUP: usize = 4;

/// Evaluates a network and back-propagates; reusable, so that a fit allocates nothing per step.
pub struct Backpropagation {
    hidden: [usize; 2],
    packed: Packed,
    /// Kernels of the last two layers the other way round, packed.
    transposed: [Vec<f32>; 2],
    blocks: Vec<Activations>,
    derivatives: [Derivatives; GROUP],
    partial: Vec<Partial>,
}

/// ∂loss of one block by what enters the activations.
#[derive(Clone, Debug)]
struct Derivatives {
    first: Vec<Lanes>,
    second: Vec<Lanes>,
    output: [Lanes; 3],
}

impl Backpropagation {
    /// For networks of these hidden widths.
    pub fn new(hidden: [usize; 2]) -> Self {
        let [first, second] = hidden.map(|width| vec![Lanes::ZERO; width]);
        let derivatives = Derivatives { first, second, output: [Lanes::ZERO; 3] };
        Self {
            hidden,
            packed: Packed::new(hidden, &vec![0.0; weight_count(hidden)], Live::all(hidden)),
            transposed: [Vec::new(), Vec::new()],
            blocks: Vec::new(),
            derivatives: std::array::from_fn(|_| derivatives.clone()),
            partial: vec![Partial::ZERO; weight_count(hidden)],
        }
    }

    /// f_r before the clamp at zero, for every pair of directions (also those below the horizon); keeps what
    /// [`backward`](Self::backward) needs. What is read of their azimuth is what they were prepared with.
    ///
    /// # Panics
    /// If the lengths of `weights` or `out` do not fit (a bug of the caller).
    pub fn forward(&mut self, weights: &[f32], at: &Prepared, out: &mut [Rgb]) {
        assert_eq!(weights.len(), weight_count(self.hidden), "weights of this shape");
        assert_eq!(at.len(), out.len(), "one output per pair of directions");
        self.packed.refill(self.hidden, weights);
        self.blocks.resize(at.blocks().len(), Activations::EMPTY);
        self.blocks.iter_mut().for_each(|block| block.resize(self.hidden));
        let Self { packed, blocks, .. } = self;
        InstructionSet::fastest().run(Forward { network: packed, at: at.blocks(), out, blocks });
    }

    /// ∂loss/∂weights from ∂loss/∂f at the directions of the last [`forward`](Self::forward), written to `gradient`.
    ///
    /// # Panics
    /// If the lengths do not fit (a bug of the caller).
    pub fn backward(&mut self, weights: &[f32], at: &Prepared, loss_by_value: &[Rgb], gradient: &mut [f32]) {
        assert_eq!(weights.len(), gradient.len(), "one derivative per weight");
        assert_eq!(at.len(), loss_by_value.len(), "one derivative per pair of directions");
        assert_eq!(at.blocks().len(), self.blocks.len(), "the directions of the forward pass");
        self.transpose(weights);
        self.partial.fill(Partial::ZERO);
        let Self { hidden, transposed, blocks, derivatives, partial, .. } = self;
        let inputs = at.blocks();
        InstructionSet::fastest().run(Backward {
            hidden: *hidden,
            transposed,
            inputs,
            loss_by_value,
            blocks,
            derivatives,
            partial,
        });
        // The kernel's inputs are in its own order.
        let width = hidden[0];
        for (own, &input) in ORDER.iter().enumerate() {
            let sums = &self.partial[own * width..][..width];
            gradient[input * width..][..width].iter_mut().zip(sums).for_each(|(g, sum)| *g = sum.sum());
        }
        let rest = INPUTS * width;
        gradient[rest..].iter_mut().zip(&self.partial[rest..]).for_each(|(g, sum)| *g = sum.sum());
    }

    fn transpose(&mut self, weights: &[f32]) {
        let [_, second, third] = Layout::new(self.hidden).layers;
        let [first, other] = &self.packed.live().units;
        let units = [&first[..], other, &[0, 1, 2]];
        for (layer, (kernel, bias)) in [second, third].into_iter().enumerate() {
            let (kernel, columns) = (&weights[kernel], bias.len());
            self.transposed[layer].clear();
            let weight = |column: usize, row: usize| kernel[row * columns + column];
            pack(units[layer + 1], units[layer], weight, |_| 0.0, &mut self.transposed[layer]);
        }
    }
}

struct Forward<'a> {
    network: &'a Packed,
    at: &'a [Block],
    out: &'a mut [Rgb],
    blocks: &'a mut [Activations],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for ((at, out), block) in self.at.iter().zip(self.out.chunks_mut(LANES)).zip(self.blocks) {
            block.forward(simd, self.network, &at.inputs);
            for (lane, out) in out.iter_mut().enumerate() {
                *out = Rgb([0, 1, 2].map(|channel| block.output[channel].0[lane]));
            }
        }
    }
}

struct Backward<'a> {
    hidden: [usize; 2],
    transposed: &'a [Vec<f32>; 2],
    inputs: &'a [Block],
    loss_by_value: &'a [Rgb],
    blocks: &'a [Activations],
    derivatives: &'a mut [Derivatives; GROUP],
    partial: &'a mut [Partial],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let layers = Layout::new(self.hidden).layers;
        let groups = self.blocks.chunks(GROUP).zip(self.inputs.chunks(GROUP));
        for ((blocks, inputs), by_value) in groups.zip(self.loss_by_value.chunks(GROUP * LANES)) {
            let by = &mut self.derivatives[..blocks.len()];
            for ((by, block), by_value) in by.iter_mut().zip(blocks).zip(by_value.chunks(LANES)) {
                by.output = [Lanes::ZERO; 3];
                for (lane, value) in by_value.iter().enumerate() {
                    for channel in 0..3 {
                        // d(exp(y) − 1)/dy = f + 1
                        by.output[channel].0[lane] = value[channel] * (block.output[channel].0[lane] + 1.0);
                    }
                }
                dense::<S, false>(simd, &by.output, &self.transposed[1], &mut by.second);
                stop_where_silent(simd, &block.second, &mut by.second);
                dense::<S, false>(simd, &by.second, &self.transposed[0], &mut by.first);
                stop_where_silent(simd, &block.first, &mut by.first);
            }
            let (by, count) = (&*by, blocks.len());
            let [by_first, by_second] = [rows(by, |by| &by.first), rows(by, |by| &by.second)];
            let [first, second] = [rows(blocks, |block| &block.first), rows(blocks, |block| &block.second)];
            let by_output = rows(by, |by| &by.output);
            let inputs = rows(inputs, |block| &block.inputs);
            for ((input, by_output), (kernel, bias)) in
                [(inputs, by_first), (first, by_second), (second, by_output)].into_iter().zip(layers.clone())
            {
                let sums = &mut self.partial[kernel.start..bias.end];
                accumulate(simd, &input[..count], &by_output[..count], bias.len(), sums);
            }
        }
    }
}

/// One list of rows for each block of a group; a group that is not full repeats its last.
#[inline(always)]
fn rows<'a, T>(blocks: &'a [T], of: impl Fn(&'a T) -> &'a [Lanes]) -> [&'a [Lanes]; GROUP] {
    std::array::from_fn(|i| of(&blocks[i.min(blocks.len() - 1)]))
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
        let mut values = vec![Rgb::BLACK; samples.at.len()];
        let mut pass = Backpropagation::new(network.hidden());
        pass.forward(network.weights(), &samples.at, &mut values);
        let own = features(samples, &values);
        Objective::FIT.loss(samples, &own, wanted, &mut vec![0.0; own.len()])
    }

    #[test]
    fn forward_agrees_with_the_plain_loop_in_f64() {
        let (network, samples) = (random_network(1, 0), samples());
        let mut values = vec![Rgb::BLACK; samples.at.len()];
        Backpropagation::new(network.hidden()).forward(network.weights(), &samples.at, &mut values);
        for (at, value) in samples.at.directions().iter().zip(&values) {
            for (own, plain) in value.0.into_iter().zip(forward_plainly(&network, at.half_diff())) {
                assert!((f64::from(own) - plain).abs() <= 2e-6 * (1.0 + plain.abs()), "{own} {plain}");
            }
        }
        let mut evaluated = vec![Rgb::BLACK; values.len()];
        network.eval_signed_into(samples.at.directions(), &mut evaluated);
        for (a, b) in values.iter().zip(&evaluated) {
            assert!(a.zip(*b, |a, b| (a - b).abs()).max() < 1e-5);
        }
    }

    #[test]
    fn gradient_agrees_with_finite_differences() {
        let (network, target, samples) = (random_network(1, 0), random_network(2, 0), samples());
        let wanted = features(&samples, &samples.values(&target));
        let mut values = vec![Rgb::BLACK; samples.at.len()];
        let mut pass = Backpropagation::new(network.hidden());
        pass.forward(network.weights(), &samples.at, &mut values);
        let mut own = vec![0.0; wanted.len()];
        features_into(&samples, &values, &mut own);
        let mut by_feature = vec![0.0; own.len()];
        Objective::FIT.loss(&samples, &own, &wanted, &mut by_feature);
        let mut by_value = vec![Rgb::BLACK; values.len()];
        pull_back(&samples, &values, &own, &by_feature, &mut by_value);
        let mut gradient = vec![0.0; network.weights().len()];
        pass.backward(network.weights(), &samples.at, &by_value, &mut gradient);
        assert!(gradient.iter().all(|g| g.is_finite()));
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
