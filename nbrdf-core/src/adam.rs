//! Adam, for fits outside the autodiff framework.
//!
//! D. Kingma, J. Ba, *Adam: A Method for Stochastic Optimization* (2015), algorithm 1.

/// First and second moments of a list of parameters.
#[derive(Clone, Debug)]
pub struct Adam {
    mean: Vec<f32>,
    square: Vec<f32>,
    step: i32,
}

impl Adam {
    const DECAY_MEAN: f32 = 0.9;
    const DECAY_SQUARE: f32 = 0.999;

    /// For this many parameters.
    pub fn new(parameters: usize) -> Self {
        Self { mean: vec![0.0; parameters], square: vec![0.0; parameters], step: 0 }
    }

    /// One step downhill.
    pub fn step(&mut self, rate: f32, gradient: &[f32], parameters: &mut [f32]) {
        self.step += 1;
        let mean_bias = 1.0 - Self::DECAY_MEAN.powi(self.step);
        let square_bias = 1.0 - Self::DECAY_SQUARE.powi(self.step);
        let moments = self.mean.iter_mut().zip(&mut self.square);
        for ((parameter, g), (mean, square)) in parameters.iter_mut().zip(gradient).zip(moments) {
            *mean += (1.0 - Self::DECAY_MEAN) * (g - *mean);
            *square += (1.0 - Self::DECAY_SQUARE) * (g * g - *square);
            *parameter -= rate * (*mean / mean_bias) / ((*square / square_bias).sqrt() + 1e-8);
        }
    }
}
