//! A dense layer and what follows it as one candle operation: y = activation(x Wᵀ + b).
//!
//! candle's own operations make one pass over memory each, and their derivatives more; on a batch of thirty-two this
//! takes longer than the products themselves. The gradients of W and b are left where the optimizer reads them.

use std::sync::{Arc, Mutex};

use candle_core::{CpuStorage, CustomOp3, Device, Layout, Result, Shape, Storage, Tensor, bail};
use faer::{MatMut, MatRef};

use crate::activation::Activation;
use crate::locked;
use crate::product::multiply;

/// Where the gradients of a layer go.
pub(crate) struct Gradients {
    pub weight: Arc<Mutex<Vec<f32>>>,
    pub bias: Arc<Mutex<Vec<f32>>>,
}

struct Dense {
    gradients: Gradients,
    activation: Option<Activation>,
    /// ∂y/∂(x Wᵀ + b) \[rows, outputs\], left by the forward pass; empty without an activation.
    slopes: Mutex<Vec<f32>>,
}

/// activation(x Wᵀ + b) \[rows, outputs\] of x \[rows, inputs\], W \[outputs, inputs\] and b \[outputs\].
pub(crate) fn dense(
    x: &Tensor,
    weight: &Tensor,
    bias: &Tensor,
    activation: Option<Activation>,
    gradients: Gradients,
) -> Result<Tensor> {
    x.contiguous()?.apply_op3(weight, bias, Dense { gradients, activation, slopes: Mutex::default() })
}

/// The numbers of a tensor that lies in memory without gaps.
pub(crate) fn numbers<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let Some((start, end)) = layout.contiguous_offsets() else { bail!("expected a tensor without gaps") };
    Ok(&storage.as_slice::<f32>()?[start..end])
}

/// Hands the numbers of a tensor to `then`.
pub(crate) fn with_numbers<T>(tensor: &Tensor, then: impl FnOnce(&[f32]) -> Result<T>) -> Result<T> {
    let (storage, layout) = tensor.storage_and_layout();
    match &*storage {
        Storage::Cpu(storage) => then(numbers(storage, layout)?),
        _ => bail!("expected a tensor in main memory"),
    }
}

impl CustomOp3 for Dense {
    fn name(&self) -> &'static str {
        "dense-layer"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        weight: &CpuStorage,
        weight_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let ((rows, inputs), outputs) = (x_layout.shape().dims2()?, bias_layout.shape().dims1()?);
        if weight_layout.shape().dims2()? != (outputs, inputs) {
            bail!("expected weights [{outputs}, {inputs}], found {:?}", weight_layout.shape());
        }
        let (x, weight, bias) = (numbers(x, x_layout)?, numbers(weight, weight_layout)?, numbers(bias, bias_layout)?);
        let mut y = vec![0.0; rows * outputs];
        let weight = MatRef::from_row_major_slice(weight, outputs, inputs).transpose();
        let x = MatRef::from_row_major_slice(x, rows, inputs);
        multiply(MatMut::from_row_major_slice_mut(&mut y, rows, outputs), x, weight);
        for row in y.chunks_exact_mut(outputs) {
            row.iter_mut().zip(bias).for_each(|(y, bias)| *y += bias);
        }
        if let Some(activation) = self.activation {
            let mut slopes = locked(&self.slopes);
            slopes.resize(y.len(), 0.0);
            activation.apply(&mut y, Some(&mut slopes));
        }
        Ok((CpuStorage::F32(y), Shape::from((rows, outputs))))
    }

    fn bwd(
        &self,
        x: &Tensor,
        weight: &Tensor,
        _: &Tensor,
        _: &Tensor,
        by_y: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let ((rows, inputs), outputs) = (x.dims2()?, weight.dim(0)?);
        let mut by_sum = with_numbers(&by_y.contiguous()?, |by_y| Ok(by_y.to_vec()))?;
        if self.activation.is_some() {
            let slopes = locked(&self.slopes);
            by_sum.iter_mut().zip(slopes.iter()).for_each(|(by, slope)| *by *= slope);
        }
        let by = MatRef::from_row_major_slice(&by_sum, rows, outputs);
        let by_x = match x.track_op() {
            false => None,
            true => {
                let mut by_x = vec![0.0; rows * inputs];
                with_numbers(weight, |weight| {
                    let weight = MatRef::from_row_major_slice(weight, outputs, inputs);
                    multiply(MatMut::from_row_major_slice_mut(&mut by_x, rows, inputs), by, weight);
                    Ok(())
                })?;
                Some(Tensor::from_vec(by_x, (rows, inputs), &Device::Cpu)?)
            }
        };
        let mut by_weight = locked(&self.gradients.weight);
        with_numbers(x, |x| {
            let x = MatRef::from_row_major_slice(x, rows, inputs);
            multiply(MatMut::from_row_major_slice_mut(&mut by_weight, outputs, inputs), by.transpose(), x);
            Ok(())
        })?;
        let mut by_bias = locked(&self.gradients.bias);
        by_bias.fill(0.0);
        for row in by_sum.chunks_exact(outputs) {
            by_bias.iter_mut().zip(row).for_each(|(sum, by)| *sum += by);
        }
        Ok((by_x, None, None))
    }
}

#[cfg(test)]
mod tests {
    use candle_core::Var;

    use super::*;

    fn var(rows: usize, columns: usize, phase: f32) -> Result<Var> {
        let values: Vec<f32> = (0..rows * columns).map(|i| (i as f32 * 0.7 + phase).sin()).collect();
        Var::from_tensor(&Tensor::from_vec(values, (rows, columns), &Device::Cpu)?)
    }

    fn assert_close(own: &Tensor, other: &Tensor) -> Result<()> {
        let [own, other] = [own, other].map(|t| t.flatten_all()?.to_vec1::<f32>());
        for (own, other) in own?.into_iter().zip(other?) {
            assert!((own - other).abs() < 1e-5 * (1.0 + other.abs()), "{own} {other}");
        }
        Ok(())
    }

    #[test]
    fn values_and_derivatives_are_those_of_candles_own_operations() -> Result<()> {
        let (x, weight) = (var(5, 7, 0.1)?, var(4, 7, 0.2)?);
        let bias = Var::from_tensor(&var(1, 4, 0.3)?.squeeze(0)?)?;
        let target = var(5, 4, 0.4)?;
        for activation in [None, Some(Activation::Silu), Some(Activation::Relu)] {
            let plain = x.matmul(&weight.t()?)?.broadcast_add(&bias)?;
            let plain = match activation {
                None => plain,
                Some(Activation::Silu) => plain.silu()?,
                Some(Activation::Relu) => plain.relu()?,
            };
            let [by_weight, by_bias] = [4 * 7, 4].map(|count| Arc::new(Mutex::new(vec![9.0; count])));
            let gradients = Gradients { weight: Arc::clone(&by_weight), bias: Arc::clone(&by_bias) };
            let own = dense(&x, &weight, &bias, activation, gradients)?;
            assert_close(&own, &plain)?;
            let [own, plain] = [own, plain].map(|y| y.mul(&target)?.sum_all()?.backward());
            let (own, plain) = (own?, plain?);
            assert_close(own.get(&x).unwrap(), plain.get(&x).unwrap())?;
            for (own, var) in [(by_weight, &weight), (by_bias, &bias)] {
                let own = Tensor::from_vec(locked(&own).clone(), var.shape(), &Device::Cpu)?;
                assert_close(&own, plain.get(var).unwrap())?;
            }
        }
        Ok(())
    }

    #[test]
    fn weights_of_another_shape_are_refused() -> Result<()> {
        let bias = var(1, 4, 0.3)?.squeeze(0)?;
        let (x, weight) = (var(5, 7, 0.1)?, var(4, 6, 0.2)?);
        let gradients = Gradients { weight: Arc::default(), bias: Arc::default() };
        assert!(dense(&x, &weight, &bias, None, gradients).is_err());
        Ok(())
    }
}
