//! The loop that everybody would write first, against which all speeds are quoted.
//!
//! Nested vectors as in the evaluation code published with Sztrajman et al. (2021), one direction at a time. Half and
//! difference vectors are made without trigonometry, which that code does with it: this loop is the faster of the two.

use crate::{Brdf, Directions, HalfDiff, Nbrdf, Rgb};

/// One layer: a row of weights for each input, and the biases.
struct Layer {
    kernel: Vec<Vec<f32>>,
    bias: Vec<f32>,
}

/// A network as nested vectors.
pub struct ReferenceLoop {
    layers: Vec<Layer>,
}

impl ReferenceLoop {
    /// The same function as `network`, slowly.
    pub fn new(network: &Nbrdf) -> Self {
        let weights = network.weights();
        let layer = |(kernel, bias): (std::ops::Range<usize>, std::ops::Range<usize>)| Layer {
            kernel: weights[kernel].chunks(bias.len()).map(<[f32]>::to_vec).collect(),
            bias: weights[bias].to_vec(),
        };
        Self { layers: network.layout().layers.into_iter().map(layer).collect() }
    }
}

impl Brdf for ReferenceLoop {
    fn eval(&self, at: Directions) -> Rgb {
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let HalfDiff { half, diff } = at.half_diff();
        let mut values = vec![half.x, half.y, half.z, diff.x, diff.y, diff.z];
        for (index, Layer { kernel, bias }) in self.layers.iter().enumerate() {
            let mut next = bias.clone();
            for (value, row) in values.iter().zip(kernel) {
                for (sum, weight) in next.iter_mut().zip(row) {
                    *sum += value * weight;
                }
            }
            if index + 1 < self.layers.len() {
                next.iter_mut().for_each(|sum| *sum = sum.max(0.0));
            }
            values = next;
        }
        Rgb([0, 1, 2].map(|channel| values[channel].min(80.0).exp_m1().max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nbrdf::fit::random_network;
    use crate::sampling::rus32k;

    #[test]
    fn the_slow_loop_is_the_same_function() {
        let network = random_network(1, 0);
        let reference = ReferenceLoop::new(&network);
        for &at in rus32k().iter().step_by(101) {
            let apart = reference.eval(at).zip(network.eval(at), |a, b| (a - b).abs());
            assert!(apart.max() < 1e-5, "{apart:?}");
        }
    }
}
