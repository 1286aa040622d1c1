//! Adam and AdamW, one pass over memory per step.
//!
//! D. Kingma, J. Ba, *Adam: A Method for Stochastic Optimization* (2015), algorithm 1; I. Loshchilov, F. Hutter,
//! *Decoupled Weight Decay Regularization* (2019), algorithm 2.

use pulp::{Simd, WithSimd};

use crate::simd::InstructionSet;

const DECAY_MEAN: f64 = 0.9;
const DECAY_SQUARE: f64 = 0.999;
const EPSILON: f32 = 1e-8;

/// Running means of a gradient and of its square.
#[derive(Clone, Debug)]
pub struct Adam {
    /// First moments, one per parameter.
    pub mean: Vec<f32>,
    /// Second moments, one per parameter.
    pub square: Vec<f32>,
}

/// How far one step goes.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// Number of the step, from 1.
    pub step: usize,
    /// Learning rate.
    pub rate: f64,
    /// What the gradient is multiplied by, to clip it.
    pub shrink: f64,
    /// Decoupled weight decay per unit of rate.
    pub decay: f64,
}

impl Pace {
    /// Plain Adam: no clipping, no decay.
    pub const fn plain(step: usize, rate: f64) -> Self {
        Self { step, rate, shrink: 1.0, decay: 0.0 }
    }
}

impl Adam {
    /// At rest, for this many parameters.
    pub fn new(parameters: usize) -> Self {
        Self { mean: vec![0.0; parameters], square: vec![0.0; parameters] }
    }

    /// One step downhill.
    pub fn step(&mut self, pace: &Pace, gradient: &[f32], parameters: &mut [f32]) {
        update(pace, gradient, &mut self.mean, &mut self.square, parameters);
    }
}

/// One step downhill, on any part of a list of parameters.
///
/// # Panics
/// If the slices differ in length (a bug of the caller).
pub fn update(pace: &Pace, gradient: &[f32], mean: &mut [f32], square: &mut [f32], parameters: &mut [f32]) {
    let count = parameters.len();
    assert!([gradient.len(), mean.len(), square.len()] == [count; 3], "one number per parameter");
    let power = pace.step as i32;
    InstructionSet::fastest().run(Update {
        shrink: pace.shrink as f32,
        mean_scale: (pace.rate / (1.0 - DECAY_MEAN.powi(power))) as f32,
        square_scale: (1.0 / (1.0 - DECAY_SQUARE.powi(power))) as f32,
        keep: (1.0 - pace.rate * pace.decay) as f32,
        gradient,
        mean,
        square,
        parameters,
    });
}

struct Update<'a> {
    shrink: f32,
    mean_scale: f32,
    square_scale: f32,
    keep: f32,
    gradient: &'a [f32],
    mean: &'a mut [f32],
    square: &'a mut [f32],
    parameters: &'a mut [f32],
}

impl Update<'_> {
    /// Mean, square and value after the step.
    #[inline(always)]
    fn one<S: Simd>(&self, simd: S, g: S::f32s, [mean, square, value]: [S::f32s; 3]) -> [S::f32s; 3] {
        let constant = |v: f32| simd.splat_f32s(v);
        let [to_mean, to_square] = [1.0 - DECAY_MEAN, 1.0 - DECAY_SQUARE].map(|v| v as f32);
        let g = simd.mul_f32s(g, constant(self.shrink));
        let mean = simd.mul_add_e_f32s(constant(to_mean), simd.sub_f32s(g, mean), mean);
        let square = simd.mul_add_e_f32s(constant(to_square), simd.sub_f32s(simd.mul_f32s(g, g), square), square);
        let size = simd.sqrt_f32s(simd.mul_f32s(square, constant(self.square_scale)));
        let size = simd.add_f32s(size, constant(EPSILON));
        let towards = simd.div_f32s(simd.mul_f32s(mean, constant(self.mean_scale)), size);
        [mean, square, simd.sub_f32s(simd.mul_f32s(value, constant(self.keep)), towards)]
    }
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let (gradient, gradient_rest) = S::as_simd_f32s(self.gradient);
        let [(mean, mean_rest), (square, square_rest), (values, values_rest)] =
            [&mut self.mean, &mut self.square, &mut self.parameters]
                .map(|list| S::as_mut_simd_f32s(std::mem::take(list)));
        for i in 0..values.len() {
            [mean[i], square[i], values[i]] = self.one(simd, gradient[i], [mean[i], square[i], values[i]]);
        }
        let rests = [mean_rest, square_rest, values_rest];
        let last = rests.each_ref().map(|rest| simd.partial_load_f32s(rest));
        let last = self.one(simd, simd.partial_load_f32s(gradient_rest), last);
        rests.into_iter().zip(last).for_each(|(rest, last)| simd.partial_store_f32s(rest, last));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_those_of_the_algorithm() {
        let count = 37;
        let (mut adam, mut values) = (Adam::new(count), vec![1.0f32; count]);
        let (mut mean, mut square, mut plain) = (vec![0.0f64; count], vec![0.0f64; count], vec![1.0f64; count]);
        for step in 1..=5 {
            let pace = Pace { step, rate: 0.01, shrink: 0.5, decay: 0.1 };
            let gradient: Vec<f32> = (0..count).map(|i| ((i + step) as f32).sin()).collect();
            adam.step(&pace, &gradient, &mut values);
            for i in 0..count {
                let g = 0.5 * f64::from(gradient[i]);
                mean[i] = 0.9 * mean[i] + 0.1 * g;
                square[i] = 0.999 * square[i] + 0.001 * g * g;
                let (m, v) =
                    (mean[i] / (1.0 - 0.9f64.powi(step as i32)), square[i] / (1.0 - 0.999f64.powi(step as i32)));
                plain[i] = plain[i] * (1.0 - 0.01 * 0.1) - 0.01 * m / (v.sqrt() + 1e-8);
                assert!((f64::from(values[i]) - plain[i]).abs() < 1e-6, "step {step}: {} {}", values[i], plain[i]);
            }
        }
    }
}
