//! Named trainable tensors, their initial values, and dense layers on them.

use std::sync::{Arc, Mutex};

use candle_core::{DType, Device, Result, Tensor, Var};
use rand::{Rng, RngExt};

use crate::activation::Activation;
use crate::layer::{Gradients, dense};

/// Trainable tensors in a fixed order.
pub(crate) struct Parameters {
    entries: Vec<Parameter>,
}

/// A trainable tensor.
pub(crate) struct Parameter {
    pub name: String,
    pub var: Var,
    /// Where a backward pass leaves its gradient: always the same memory, which candle's own bookkeeping would allocate,
    /// clear and add up anew in every step.
    pub gradient: Arc<Mutex<Vec<f32>>>,
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
        self.add(format!("{name}.bias"), Tensor::zeros(outputs, DType::F32, &Device::Cpu)?)
    }

    fn add(&mut self, name: String, value: Tensor) -> Result<()> {
        let gradient = Arc::new(Mutex::new(vec![0.0; value.elem_count()]));
        self.entries.push(Parameter { name, var: Var::from_tensor(&value)?, gradient });
        Ok(())
    }

    /// In the order in which they were added.
    pub fn iter(&self) -> std::slice::Iter<'_, Parameter> {
        self.entries.iter()
    }

    fn get(&self, name: &str) -> Result<&Parameter> {
        let found = self.entries.iter().find(|entry| entry.name == name);
        found.ok_or_else(|| candle_core::Error::Msg(format!("no parameter '{name}'")))
    }

    /// `activation(x Wᵀ + b)` \[rows, outputs\] of the layer `name` for x \[rows, inputs\]; a layer stands once in a model.
    pub fn dense(&self, name: &str, x: &Tensor, activation: Option<Activation>) -> Result<Tensor> {
        let (weight, bias) = (self.get(&format!("{name}.weight"))?, self.get(&format!("{name}.bias"))?);
        let gradients = Gradients { weight: Arc::clone(&weight.gradient), bias: Arc::clone(&bias.gradient) };
        dense(x, &weight.var, &bias.var, activation, gradients)
    }
}
