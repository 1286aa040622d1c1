//! Dense layers for a handful of rows: what decoding one code, or thirty-three, consists of.
//!
//! Lanes are outputs, inputs are broadcast; weights lie in the order in which they are read, since for a single row the
//! time is that of reading them. Every output sums its inputs in order, so that all vector sets give the same bits.

use pulp::{Simd, WithSimd};

use crate::simd::{InstructionSet, LANES, Lanes, exp_minus_one};

/// A dense layer, packed.
#[derive(Clone, Debug)]
pub struct Dense {
    inputs: usize,
    outputs: usize,
    /// For every [`LANES`] outputs their biases, then the weights of each input to them.
    packed: Vec<Lanes>,
}

/// What is added to the products.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bias {
    /// The layer's bias: values pass.
    Added,
    /// Nothing: derivatives pass.
    LeftOut,
}

impl Dense {
    /// From weights \[outputs, inputs\] (row-major) and biases \[outputs\].
    ///
    /// # Panics
    /// If there are not `weight.len() / bias.len()` inputs for each output (a bug of the caller).
    pub fn new(weight: &[f32], bias: &[f32]) -> Self {
        let outputs = bias.len();
        let inputs = weight.len() / outputs.max(1);
        assert_eq!(weight.len(), inputs * outputs, "a weight for each input and output");
        let mut packed = Vec::with_capacity(outputs.div_ceil(LANES) * (inputs + 1));
        for tile in (0..outputs).step_by(LANES) {
            let lanes = |value: &dyn Fn(usize) -> f32| {
                Lanes(std::array::from_fn(|lane| if tile + lane < outputs { value(tile + lane) } else { 0.0 }))
            };
            packed.push(lanes(&|output| bias[output]));
            packed.extend((0..inputs).map(|input| lanes(&|output| weight[output * inputs + input])));
        }
        Self { inputs, outputs, packed }
    }

    /// Numbers of an input row.
    pub const fn inputs(&self) -> usize {
        self.inputs
    }

    /// Numbers of an output row.
    pub const fn outputs(&self) -> usize {
        self.outputs
    }

    /// Bytes of weights and biases.
    pub const fn bytes(&self) -> usize {
        size_of::<f32>() * (self.inputs + 1) * self.outputs
    }

    /// `out` \[rows, outputs\] = `x` \[rows, inputs\] · weightᵀ, with or without the bias.
    ///
    /// # Panics
    /// If the lengths are not those of the same number of rows (a bug of the caller).
    pub fn apply(&self, x: &[f32], bias: Bias, out: &mut [f32]) {
        let rows = out.len() / self.outputs.max(1);
        assert_eq!((x.len(), out.len()), (rows * self.inputs, rows * self.outputs), "whole rows");
        InstructionSet::fastest().run(Apply { layer: self, x, bias, out });
    }
}

struct Apply<'a> {
    layer: &'a Dense,
    x: &'a [f32],
    bias: Bias,
    out: &'a mut [f32],
}

impl WithSimd for Apply<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { layer, x, bias, out } = self;
        let rows = out.len() / layer.outputs.max(1);
        for (index, tile) in layer.packed.chunks_exact(layer.inputs + 1).enumerate() {
            let mut row = 0;
            while row < rows {
                // As many rows as keep twelve sums in registers.
                row += match (LANES / S::F32_LANES, rows - row) {
                    (2, 6..) => tile_of::<S, 2, 6>(simd, layer, tile, index, x, row, bias, out),
                    (4, 3..) => tile_of::<S, 4, 3>(simd, layer, tile, index, x, row, bias, out),
                    (2, _) => tile_of::<S, 2, 1>(simd, layer, tile, index, x, row, bias, out),
                    (4, _) => tile_of::<S, 4, 1>(simd, layer, tile, index, x, row, bias, out),
                    (8, _) => tile_of::<S, 8, 1>(simd, layer, tile, index, x, row, bias, out),
                    _ => tile_of::<S, LANES, 1>(simd, layer, tile, index, x, row, bias, out),
                };
            }
        }
    }
}

/// [`LANES`] outputs, `V` vectors of them, for `R` rows; returns `R`.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "one loop, called for every shape of a tile")]
fn tile_of<S: Simd, const V: usize, const R: usize>(
    simd: S,
    layer: &Dense,
    tile: &[Lanes],
    index: usize,
    x: &[f32],
    row: usize,
    bias: Bias,
    out: &mut [f32],
) -> usize {
    let Some((biases, weights)) = tile.split_first() else { return R };
    let mut sums = [[simd.splat_f32s(0.0); V]; R];
    if bias == Bias::Added {
        for sums in &mut sums {
            sums.copy_from_slice(&biases.vectors::<S>()[..V]);
        }
    }
    let rows: [&[f32]; R] = std::array::from_fn(|r| &x[(row + r) * layer.inputs..][..layer.inputs]);
    for (input, weights) in weights.iter().enumerate() {
        let weights = &weights.vectors::<S>()[..V];
        for (sums, x) in sums.iter_mut().zip(rows) {
            let x = simd.splat_f32s(x[input]);
            for (sum, w) in sums.iter_mut().zip(weights) {
                *sum = simd.mul_add_e_f32s(x, *w, *sum);
            }
        }
    }
    let first = index * LANES;
    let count = LANES.min(layer.outputs - first);
    for (r, sums) in sums.into_iter().enumerate() {
        let mut lanes = Lanes::ZERO;
        lanes.vectors_mut::<S>()[..V].copy_from_slice(&sums);
        out[(row + r) * layer.outputs + first..][..count].copy_from_slice(&lanes.0[..count]);
    }
    R
}

/// SiLU, x / (1 + exp(−x)) (S. Elfwing et al., *Sigmoid-Weighted Linear Units*, 2018), in place.
///
/// Where `slopes` is given, it becomes the derivative at every x; it must be as long as `x`.
pub fn silu(x: &mut [f32], slopes: Option<&mut [f32]>) {
    InstructionSet::fastest().run(Silu { x, slopes });
}

struct Silu<'a> {
    x: &'a mut [f32],
    slopes: Option<&'a mut [f32]>,
}

impl WithSimd for Silu<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { x, mut slopes } = self;
        for start in (0..x.len()).step_by(LANES) {
            let count = LANES.min(x.len() - start);
            let (mut values, mut slope) = (Lanes::ZERO, Lanes::ZERO);
            values.0[..count].copy_from_slice(&x[start..start + count]);
            let [one, two] = [1.0, 2.0].map(|v| simd.splat_f32s(v));
            for (x, slope) in values.vectors_mut::<S>().iter_mut().zip(slope.vectors_mut::<S>()) {
                let sigmoid = simd.div_f32s(one, simd.add_f32s(two, exp_minus_one(simd, simd.neg_f32s(*x))));
                let silu = simd.mul_f32s(*x, sigmoid);
                // σ + x σ (1 − σ)
                *slope = simd.mul_add_e_f32s(silu, simd.sub_f32s(one, sigmoid), sigmoid);
                *x = silu;
            }
            x[start..start + count].copy_from_slice(&values.0[..count]);
            if let Some(slopes) = &mut slopes {
                slopes[start..start + count].copy_from_slice(&slope.0[..count]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::RngExt;

    use super::*;
    use crate::nbrdf::fit::generator;

    fn random(count: usize, stream: u64) -> Vec<f32> {
        let mut rng = generator(5, stream);
        (0..count).map(|_| rng.random_range(-1.0..1.0f32)).collect()
    }

    #[test]
    fn any_shape_is_the_plain_product() {
        for (inputs, outputs, rows) in [(1, 1, 1), (24, 256, 1), (28, 22, 3), (7, 33, 6), (512, 609, 2), (5, 64, 33)] {
            let (weight, bias) = (random(inputs * outputs, 0), random(outputs, 1));
            let x = random(rows * inputs, 2);
            let layer = Dense::new(&weight, &bias);
            for added in [Bias::Added, Bias::LeftOut] {
                let mut out = vec![0.0; rows * outputs];
                layer.apply(&x, added, &mut out);
                for (place, own) in out.iter().enumerate() {
                    let (row, output) = (place / outputs, place % outputs);
                    let products = x[row * inputs..][..inputs].iter().zip(&weight[output * inputs..]);
                    let start = if added == Bias::Added { f64::from(bias[output]) } else { 0.0 };
                    let plain = start + products.map(|(x, w)| f64::from(x * w)).sum::<f64>();
                    assert!((f64::from(*own) - plain).abs() < 1e-4, "{inputs} {outputs} {rows}: {own} {plain}");
                }
            }
        }
    }

    #[test]
    fn silu_and_its_slope_are_those_of_the_formula() {
        let x: Vec<f32> = (0..101).map(|i| -90.0 + 1.8 * i as f32).chain([-1e-3, 0.0, 0.5]).collect();
        let (mut values, mut slopes) = (x.clone(), vec![0.0; x.len()]);
        silu(&mut values, Some(&mut slopes));
        for ((x, value), slope) in x.into_iter().map(f64::from).zip(values).zip(slopes) {
            let sigmoid = 1.0 / (1.0 + (-x).exp());
            assert!((f64::from(value) - x * sigmoid).abs() < 1e-6 * (1.0 + x.abs()), "{x}: {value}");
            assert!((f64::from(slope) - (sigmoid + x * sigmoid * (1.0 - sigmoid))).abs() < 3e-6, "{x}: {slope}");
        }
    }
}
