//! A network's weights in the order in which the kernel reads them.

use super::dense::pack;
use super::half_diff::ORDER;
use crate::nbrdf::{INPUTS, Layout};

/// Units that are evaluated, in ascending order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Live {
    /// Whether h.y is read; it is 0 for isotropic materials.
    pub half_y: bool,
    /// Units of the two hidden layers.
    pub units: [Vec<usize>; 2],
}

impl Live {
    /// Everything.
    pub fn all(hidden: [usize; 2]) -> Self {
        Self { half_y: true, units: hidden.map(|width| (0..width).collect()) }
    }

    /// Multiplications per evaluation, biases and exponentials not counted: 630 of a whole published network.
    pub fn multiply_adds(&self) -> usize {
        let [first, second] = [self.units[0].len(), self.units[1].len()];
        self.inputs() * first + first * second + second * 3
    }

    /// Numbers that evaluation reads: weights and biases.
    pub fn weights(&self) -> usize {
        self.multiply_adds() + self.units[0].len() + self.units[1].len() + 3
    }

    /// Whether nothing is left out of a network of these hidden widths.
    pub fn is_all(&self, hidden: [usize; 2]) -> bool {
        self.half_y && [0, 1].map(|layer| self.units[layer].len()) == hidden
    }

    /// How many of a block's inputs are read.
    pub(crate) const fn inputs(&self) -> usize {
        if self.half_y { INPUTS } else { INPUTS - 1 }
    }
}

/// Inputs, units and weights that are evaluated; the others are left out.
#[derive(Clone, Debug)]
pub(crate) struct Packed {
    live: Live,
    weights: Vec<f32>,
}

impl Packed {
    /// Packs what is live of these flattened weights.
    pub fn new(hidden: [usize; 2], flat: &[f32], live: Live) -> Self {
        let mut packed = Self { live, weights: Vec::new() };
        packed.refill(hidden, flat);
        packed
    }

    /// Packs other weights of the same shape; allocates nothing.
    pub fn refill(&mut self, hidden: [usize; 2], flat: &[f32]) {
        let [first, second] = &self.live.units;
        let units = [&ORDER[..self.live.inputs()], first, second, &[0, 1, 2]];
        self.weights.clear();
        for (layer, (kernel, bias)) in Layout::new(hidden).layers.into_iter().enumerate() {
            let (kernel, bias) = (&flat[kernel], &flat[bias]);
            let weight = |input: usize, output: usize| kernel[input * bias.len() + output];
            pack(units[layer], units[layer + 1], weight, |output| bias[output], &mut self.weights);
        }
    }

    /// What is evaluated.
    pub const fn live(&self) -> &Live {
        &self.live
    }

    /// Units of the hidden layers.
    pub fn hidden(&self) -> [usize; 2] {
        [self.live.units[0].len(), self.live.units[1].len()]
    }

    /// All weights, layer by layer.
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }
}
