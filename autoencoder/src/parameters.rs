//! Named trainable tensors, their initial values, and dense layers on them.

use candle_core::{Device, Result, Tensor, Var};
use rand::{Rng, RngExt};

/// Trainable tensors in a fixed order.
pub(crate) struct Parameters {
    entries: Vec<(String, Var)>,
}

impl Parameters {
    /// None yet.
    pub fn new() -> Self {
        Self { entries: Vec::new() }
    }

    /// Adds a dense layer `name.weight` \[outputs, inputs\] and `name.bias` \[outputs\]; uniform within
    /// scale · √(6 / (inputs + outputs)) (Glorot and Bengio 2010), bias zero.
    pub fn add_dense(
        &mut self,
        name: &str,
        [inputs, outputs]: [usize; 2],
        scale: f32,
        rng: &mut impl Rng,
    ) -> Result<()> {
        let limit = scale * (6.0 / (inputs + outputs) as f32).sqrt();
        let weight: Vec<f32> = (0..inputs * outputs).map(|_| rng.random_range(-limit..=limit)).collect();
        self.add(format!("{name}.weight"), Tensor::from_vec(weight, (outputs, inputs), &Device::Cpu)?)?;
        self.add(format!("{name}.bias"), Tensor::zeros(outputs, candle_core::DType::F32, &Device::Cpu)?)
    }

    /// Adds a tensor.
    pub fn add(&mut self, name: String, value: Tensor) -> Result<()> {
        self.entries.push((name, Var::from_tensor(&value)?));
        Ok(())
    }

    /// In the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Var)> {
        self.entries.iter().map(|(name, var)| (name.as_str(), var))
    }

    fn get(&self, name: &str) -> Result<&Tensor> {
        let found = self.entries.iter().find(|(entry, _)| entry == name);
        found.map(|(_, var)| var.as_tensor()).ok_or_else(|| candle_core::Error::Msg(format!("no parameter '{name}'")))
    }

    /// `x Wᵀ + b` for x \[rows, inputs\].
    ///
    /// The bias enters as a product with ones: the derivative of a broadcast is a sum that candle does slowly.
    pub fn dense(&self, name: &str, x: &Tensor) -> Result<Tensor> {
        let bias = self.get(&format!("{name}.bias"))?;
        let ones = Tensor::ones((x.dim(0)?, 1), candle_core::DType::F32, x.device())?;
        x.matmul(&self.get(&format!("{name}.weight"))?.t()?)? + ones.matmul(&bias.unsqueeze(0)?)?
    }
}
