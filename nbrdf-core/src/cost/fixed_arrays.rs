//! The published shape as fixed arrays, one direction at a time: what a careful compiler makes of plain code.

use crate::nbrdf::PUBLISHED_HIDDEN;
use crate::{Brdf, Directions, HalfDiff, Nbrdf, Rgb};

const WIDTH: usize = PUBLISHED_HIDDEN[0];

/// A 6-21-21-3 network as arrays.
pub struct FixedArrays {
    first: ([[f32; WIDTH]; 6], [f32; WIDTH]),
    second: ([[f32; WIDTH]; WIDTH], [f32; WIDTH]),
    third: ([[f32; 3]; WIDTH], [f32; 3]),
}

impl FixedArrays {
    /// The same function as `network`; none for networks of another shape.
    pub fn new(network: &Nbrdf) -> Option<Self> {
        if network.hidden() != PUBLISHED_HIDDEN {
            return None;
        }
        let weights = network.weights();
        let [(k1, b1), (k2, b2), (k3, b3)] = network.layout().layers;
        Some(Self {
            first: (rows(&weights[k1]), row(&weights[b1])),
            second: (rows(&weights[k2]), row(&weights[b2])),
            third: (rows(&weights[k3]), row(&weights[b3])),
        })
    }
}

fn row<const N: usize>(values: &[f32]) -> [f32; N] {
    std::array::from_fn(|i| values[i])
}

fn rows<const R: usize, const N: usize>(values: &[f32]) -> [[f32; N]; R] {
    std::array::from_fn(|r| row(&values[r * N..]))
}

fn dense<const R: usize, const N: usize>(x: [f32; R], (kernel, bias): &([[f32; N]; R], [f32; N])) -> [f32; N] {
    let mut sums = *bias;
    for (x, row) in x.iter().zip(kernel) {
        for (sum, w) in sums.iter_mut().zip(row) {
            *sum += x * w;
        }
    }
    sums
}

impl Brdf for FixedArrays {
    fn eval(&self, at: Directions) -> Rgb {
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let HalfDiff { half, diff } = at.half_diff();
        let first = dense([half.x, half.y, half.z, diff.x, diff.y, diff.z], &self.first).map(|v| v.max(0.0));
        let second = dense(first, &self.second).map(|v| v.max(0.0));
        Rgb(dense(second, &self.third).map(|y| y.min(80.0).exp_m1().max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nbrdf::fit::random_network;
    use crate::sampling::rus32k;

    #[test]
    fn the_arrays_are_the_same_function() {
        let network = random_network(1, 0);
        let arrays = FixedArrays::new(&network).unwrap();
        for &at in rus32k().iter().step_by(101) {
            assert!(arrays.eval(at).zip(network.eval(at), |a, b| (a - b).abs()).max() < 1e-5);
        }
        assert!(FixedArrays::new(&Nbrdf::new([1, 1], vec![0.0; 15]).unwrap()).is_none());
    }
}
