//! How reflectance values move when the weights do: derivatives along given directions of weight space, exactly.
//!
//! The forward mode beside the reverse mode of [`gradient`](super::gradient): where there are many values and few
//! unknowns, as in refining a code, it gives the whole Jacobian. With (W, b) the weights and (Ẇ, ḃ) their change, a layer
//! y = W x + b moves by ẏ = Ẇ x + ḃ + W ẋ: one dense layer over (x, ẋ).

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use super::kernel::dense::{dense, pack};
use super::kernel::{Activations, Block, Live, ORDER, Packed};
use super::{INPUTS, Layout, weight_count};
use crate::Rgb;
use crate::brdf::{Azimuth, Prepared};
use crate::simd::{InstructionSet, LANES, Lanes};

/// f_r before the clamp at 0, and its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangents {
    /// One per pair of directions.
    pub values: Vec<Rgb>,
    /// For each change of the weights one list of derivatives, one per pair of directions.
    pub derivatives: Vec<Vec<Rgb>>,
}

/// Evaluates a network of these hidden widths and differentiates it along `changes`, each as long as `weights`.
///
/// # Panics
/// If a length does not fit, or the pairs keep their azimuth: such networks have no codes (a bug of the caller).
pub fn tangents(hidden: [usize; 2], weights: &[f32], changes: &[&[f32]], at: &Prepared) -> Tangents {
    let expected = weight_count(hidden);
    assert!(
        weights.len() == expected && changes.iter().all(|change| change.len() == expected),
        "one number per weight"
    );
    assert_eq!(at.azimuth(), Azimuth::Dropped, "pairs of isotropic materials");
    let network = Packed::new(hidden, weights, Live::all(hidden));
    let mut blocks = vec![Activations::EMPTY; at.blocks().len()];
    blocks.iter_mut().for_each(|block| block.resize(hidden));
    let set = InstructionSet::fastest();
    set.run(Primal { network: &network, at: at.blocks(), blocks: &mut blocks });
    let pick = |lists: &[Lanes; 3], lane: usize| Rgb([0, 1, 2].map(|channel| lists[channel].0[lane]));
    let values = (0..at.len()).map(|i| pick(&blocks[i / LANES].output, i % LANES)).collect();
    let along = |change: &&[f32]| {
        let packed = pack_change(hidden, weights, change);
        let mut out = vec![[Lanes::ZERO; 3]; blocks.len()];
        set.run(Along { hidden, packed: &packed, at: at.blocks(), blocks: &blocks, out: &mut out });
        (0..at.len()).map(|i| pick(&out[i / LANES], i % LANES)).collect()
    };
    Tangents { values, derivatives: changes.par_iter().map(along).collect() }
}

/// The layers over (x, ẋ): the change's rows, then, but for the first layer, the weights' own.
fn pack_change(hidden: [usize; 2], weights: &[f32], change: &[f32]) -> Vec<f32> {
    let widths = [INPUTS, hidden[0], hidden[1], 3];
    let outputs: Vec<usize> = (0..hidden[0].max(hidden[1]).max(3)).collect();
    let mut packed = Vec::with_capacity(2 * weights.len());
    for (layer, (kernel, bias)) in Layout::new(hidden).layers.into_iter().enumerate() {
        let (rows, columns) = (widths[layer], widths[layer + 1]);
        let inputs: Vec<usize> = if layer == 0 { ORDER.to_vec() } else { (0..2 * rows).collect() };
        let weight = |input: usize, output: usize| match input.checked_sub(rows) {
            None => change[kernel.start + input * columns + output],
            Some(own) => weights[kernel.start + own * columns + output],
        };
        pack(&inputs, &outputs[..columns], weight, |output| change[bias.start + output], &mut packed);
    }
    packed
}

struct Primal<'a> {
    network: &'a Packed,
    at: &'a [Block],
    blocks: &'a mut [Activations],
}

impl WithSimd for Primal<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (at, block) in self.at.iter().zip(self.blocks) {
            block.forward(simd, self.network, &at.inputs);
        }
    }
}

struct Along<'a> {
    hidden: [usize; 2],
    packed: &'a [f32],
    at: &'a [Block],
    blocks: &'a [Activations],
    out: &'a mut [[Lanes; 3]],
}

impl WithSimd for Along<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [mut first, mut second] = self.hidden.map(|width| vec![Lanes::ZERO; 2 * width]);
        let one = simd.splat_f32s(1.0);
        for ((at, block), out) in self.at.iter().zip(self.blocks).zip(self.out) {
            let (own, moved) = first.split_at_mut(self.hidden[0]);
            let weights = dense::<S, false>(simd, &at.inputs, self.packed, moved);
            own.copy_from_slice(&block.first);
            stop_where_silent(simd, own, moved);
            let (own, moved) = second.split_at_mut(self.hidden[1]);
            let weights = dense::<S, false>(simd, &first, weights, moved);
            own.copy_from_slice(&block.second);
            stop_where_silent(simd, own, moved);
            dense::<S, false>(simd, &second, weights, out);
            // d(exp(y) − 1) = (f + 1) dy
            for (out, f) in out.iter_mut().zip(&block.output) {
                for (out, f) in out.vectors_mut::<S>().iter_mut().zip(f.vectors::<S>()) {
                    *out = simd.mul_f32s(*out, simd.add_f32s(*f, one));
                }
            }
        }
    }
}

/// Where a unit does not fire, it does not move.
#[inline(always)]
pub(super) fn stop_where_silent<S: Simd>(simd: S, activations: &[Lanes], moved: &mut [Lanes]) {
    let zero = simd.splat_f32s(0.0);
    for (activation, moved) in activations.iter().zip(moved) {
        for (a, d) in activation.vectors::<S>().iter().zip(moved.vectors_mut::<S>()) {
            *d = simd.select_f32s(simd.greater_than_f32s(*a, zero), *d, zero);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nbrdf::fit::random_network;
    use crate::nbrdf::gradient::Backpropagation;
    use crate::sampling::rus32k;

    /// Forward and reverse mode are written apart from each other: Σ v · (J c) = (Jᵀ v) · c.
    #[test]
    fn forward_and_reverse_mode_agree() {
        let at = Prepared::new(rus32k().iter().step_by(300).copied().collect());
        let network = random_network(4, 0);
        let changes = [random_network(5, 0), random_network(6, 0)];
        let lists: Vec<&[f32]> = changes.iter().map(|change| change.weights()).collect();
        let found = tangents([21, 21], network.weights(), &lists, &at);
        let mut pass = Backpropagation::new([21, 21]);
        let (mut values, mut gradient) = (vec![Rgb::BLACK; at.len()], vec![0.0; network.weights().len()]);
        pass.forward(network.weights(), &at, &mut values);
        assert_eq!(values, found.values);
        let by_value: Vec<Rgb> = (0..at.len()).map(|i| Rgb([1.0, (i as f32).sin(), (i as f32).cos()])).collect();
        pass.backward(network.weights(), &at, &by_value, &mut gradient);
        for (change, derivatives) in lists.iter().zip(&found.derivatives) {
            let forward: f64 = by_value.iter().zip(derivatives).map(|(v, d)| f64::from((*v * *d).mean()) * 3.0).sum();
            let reverse: f64 = gradient.iter().zip(*change).map(|(g, c)| f64::from(g * c)).sum();
            assert!((forward - reverse).abs() < 1e-4 * (1.0 + reverse.abs()), "{forward} {reverse}");
        }
    }
}
