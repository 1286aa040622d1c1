//! The same training step in candle's and candle-nn's own operations: linear layers, batched products for the decoded
//! networks, the three terms of the loss, AdamW. Inputs and targets are prepared once, which ours are not.

use candle_core::{D, Device, Result, Tensor};
use candle_nn::optim::{AdamW, Optimizer, ParamsAdamW};
use candle_nn::{Linear, Module, VarBuilder, VarMap, linear};
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::nbrdf::objective::features;
use nbrdf_core::nbrdf::samples::{SampleCounts, Samples};
use nbrdf_core::{HalfDiff, Material};

const BATCH: usize = 32;
const FEATURES: usize = 576;

/// Model, optimizer and one batch.
pub struct PlainCandle {
    body: Vec<Linear>,
    shared: Linear,
    channel: Linear,
    trunk: Vec<Linear>,
    head: Vec<Linear>,
    optimizer: AdamW,
    input: Tensor,
    /// Network inputs \[32, 512, 6\], factors \[32, 512, 1\], wanted features of the three terms.
    at: Tensor,
    factors: Tensor,
    wanted: [Tensor; 3],
}

fn chain(builder: &VarBuilder, name: &str, widths: &[usize]) -> Result<Vec<Linear>> {
    widths.windows(2).enumerate().map(|(i, pair)| linear(pair[0], pair[1], builder.pp(format!("{name}.{i}")))).collect()
}

fn through(layers: &[Linear], x: &Tensor) -> Result<Tensor> {
    let mut x = layers[0].forward(x)?;
    for layer in &layers[1..] {
        x = layer.forward(&x.silu()?)?;
    }
    Ok(x)
}

fn mean(x: &Tensor) -> Result<Tensor> {
    x.mean(1)
}

fn repeat(x: &Tensor) -> Result<Tensor> {
    Tensor::stack(&[x, x, x], 1)
}

impl PlainCandle {
    /// With random weights; the batch is the first 32 materials.
    pub fn new(materials: &[Material]) -> Result<Self> {
        let variables = VarMap::new();
        let builder = VarBuilder::from_varmap(&variables, candle_core::DType::F32, &Device::Cpu);
        let body = chain(&builder, "body", &[FEATURES, 512, 256, 256])?;
        let (shared, channel) = (linear(256, 20, builder.pp("shared"))?, linear(512, 4, builder.pp("channel"))?);
        let trunk = chain(&builder, "trunk", &[24, 256, 512, 609])?;
        let head = chain(&builder, "head", &[28, 128, 128, 22])?;
        let optimizer = AdamW::new(variables.all_vars(), ParamsAdamW { lr: 1e-4, ..ParamsAdamW::default() })?;
        let counts = SampleCounts::STEP;
        let (mut at, mut factors, mut wanted) = (Vec::new(), Vec::new(), [Vec::new(), Vec::new(), Vec::new()]);
        for (row, material) in materials.iter().take(BATCH).enumerate() {
            let samples = Samples::random(&mut generator(7, row as u64), counts);
            for pair in samples.at.directions() {
                let HalfDiff { half, diff } = pair.half_diff();
                at.extend(half.to_array().into_iter().chain(diff.to_array()));
            }
            factors.extend_from_slice(&samples.factors);
            let own = features(&samples, &samples.values(material.brdf.as_ref()));
            let (log, rest) = own.split_at(3 * counts.log);
            let (relative, display) = rest.split_at(3 * counts.relative);
            wanted.iter_mut().zip([log, relative, display]).for_each(|(list, own)| list.extend_from_slice(own));
        }
        let directions = counts.log + counts.relative + counts.lamps * counts.pixels;
        let tensor = |values: Vec<f32>, columns: usize| {
            let rows = values.len() / (BATCH * columns);
            Tensor::from_vec(values, (BATCH, rows, columns), &Device::Cpu)
        };
        let [log, relative, display] = wanted;
        Ok(Self {
            body,
            shared,
            channel,
            trunk,
            head,
            optimizer,
            input: Tensor::randn(0f32, 1.0, (3 * BATCH, FEATURES), &Device::Cpu)?,
            at: tensor(at, 6)?,
            factors: Tensor::from_vec(factors, (BATCH, directions, 1), &Device::Cpu)?,
            wanted: [tensor(log, 3)?, tensor(relative, 3)?, tensor(display, 3)?],
        })
    }

    /// One step; the loss before it.
    pub fn step(&mut self) -> Result<f32> {
        let loss = self.loss(&self.decode(&self.encode()?)?)?;
        self.optimizer.backward_step(&loss)?;
        loss.to_scalar()
    }

    fn encode(&self) -> Result<Tensor> {
        let embedding = through(&self.body, &self.input)?.silu()?.reshape((BATCH, 3, 256))?;
        let mean = mean(&embedding)?;
        let both = Tensor::cat(&[&embedding, &repeat(&mean)?], D::Minus1)?.reshape((3 * BATCH, 512))?;
        let channels = self.channel.forward(&both)?.reshape((BATCH, 12))?;
        Tensor::cat(&[&self.shared.forward(&mean)?, &channels], 1)
    }

    fn decode(&self, code: &Tensor) -> Result<Tensor> {
        let (shared, channels) = (code.narrow(1, 0, 20)?, code.narrow(1, 20, 12)?.reshape((BATCH, 3, 4))?);
        let common = Tensor::cat(&[&shared, &mean(&channels)?], 1)?;
        let inner = through(&self.trunk, &common)?;
        let own = Tensor::cat(&[&repeat(&common)?, &channels], 2)?.reshape((3 * BATCH, 28))?;
        let columns = through(&self.head, &own)?.reshape((BATCH, 3, 22))?;
        let kernel = columns.narrow(2, 0, 21)?.transpose(1, 2)?.contiguous()?.reshape((BATCH, 63))?;
        Tensor::cat(&[&inner, &kernel, &columns.narrow(2, 21, 1)?.reshape((BATCH, 3))?], 1)
    }

    fn loss(&self, weights: &Tensor) -> Result<Tensor> {
        let SampleCounts { log, relative, pixels, lamps } = SampleCounts::STEP;
        let (mut x, mut start) = (self.at.clone(), 0);
        for (layer, (inputs, outputs)) in [(6, 21), (21, 21), (21, 3)].into_iter().enumerate() {
            let kernel = weights.narrow(1, start, inputs * outputs)?.reshape((BATCH, inputs, outputs))?;
            let bias = weights.narrow(1, start + inputs * outputs, outputs)?.reshape((BATCH, 1, outputs))?;
            start += (inputs + 1) * outputs;
            x = x.matmul(&kernel)?.broadcast_add(&bias)?;
            x = if layer < 2 { x.relu()? } else { (x.clamp(-80.0, 80.0)?.exp()? - 1.0)? };
        }
        let weighted = x.broadcast_mul(&self.factors)?;
        let [wanted_log, wanted_relative, wanted_display] = &self.wanted;
        let own = (weighted.narrow(1, 0, log)? + 1.0)?.clamp(0.1, f32::MAX)?.log()?;
        let log_term = (own - wanted_log)?.abs()?.mean_all()?;
        let own = (weighted.narrow(1, log, relative)?.relu()? + 1e-3)?.log()?;
        let relative_term = (own - wanted_relative)?.abs()?.mean_all()?;
        let radiance = weighted.narrow(1, log + relative, lamps * pixels)?.relu()?;
        let radiance = radiance.reshape((BATCH, pixels, lamps, 3))?.sum(2)?;
        let shown = radiance.clamp(1e-4, 1.0)?.powf(1.0 / 2.2)?;
        let square = (shown - wanted_display)?.sqr()?.mean((1, 2))?;
        let display_term = (square + 1e-12)?.sqrt()?.mean_all()?;
        log_term + ((relative_term * 0.2)? + (display_term * 0.3)?)?
    }
}
