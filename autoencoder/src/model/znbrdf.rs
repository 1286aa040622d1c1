//! Ours: a probe encoder, and a code and decoder that treat the colour channels alike.
//!
//! Code = shared numbers, then a few for each channel ([`CodeLayout`]; 32 = 20 + 3 · 4). Permuting RGB permutes the
//! code, and channels that are equal
//! at both ends of a path stay equal along it: no colour appears that was in neither end.

use candle_core::{D, Device, Result, Tensor};
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};
use rand::Rng;

use super::{CodeLayout, Model, add_chain, chain};
use crate::activation::Activation;
use crate::parameters::Parameters;
use crate::probe::PROBES;

/// Features of one channel: its own probes, their mean, their deviation.
pub(crate) const FEATURES: usize = 3 * PROBES;
/// What the encoder makes of one channel's features.
pub(crate) const EMBEDDING: usize = 256;
/// Widths of the encoder's layers, the same for all channels.
pub(crate) const BODY: [usize; 4] = [FEATURES, 512, 256, EMBEDDING];
/// Weights of the first two layers.
const INNER: usize = PUBLISHED_WEIGHTS - 3 * (PUBLISHED_HIDDEN[1] + 1);

/// Widths of the layers that make the first two layers' weights of what is common to all channels.
pub(crate) const fn trunk(layout: CodeLayout) -> [usize; 4] {
    [layout.common(), 256, 512, INNER]
}

/// Widths of the layers that make one channel's column of the output layer.
pub(crate) const fn head(layout: CodeLayout) -> [usize; 4] {
    [layout.own(), 128, 128, PUBLISHED_HIDDEN[1] + 1]
}

/// The trainable tensors and the start and spread of the decoded weights.
pub(crate) struct ZnbrdfModel {
    parameters: Parameters,
    layout: CodeLayout,
    /// Start \[675\], the same for all channels.
    start: Tensor,
    /// How far weights of training networks lie from it \[675\].
    spread: Tensor,
}

impl ZnbrdfModel {
    /// With random initial weights.
    pub fn new(layout: CodeLayout, start: &[f32], spread: &[f32], rng: &mut impl Rng) -> Result<Self> {
        let mut parameters = Parameters::new();
        add_chain(&mut parameters, "encoder.body", &BODY, 1.0, rng)?;
        parameters.add_dense("encoder.shared", [EMBEDDING, layout.shared], 1.0, rng)?;
        if layout.channel > 0 {
            parameters.add_dense("encoder.channel", [2 * EMBEDDING, layout.channel], 1.0, rng)?;
        }
        add_chain(&mut parameters, "decoder.trunk", &trunk(layout), 0.1, rng)?;
        add_chain(&mut parameters, "decoder.head", &head(layout), 0.1, rng)?;
        let row = |values: &[f32]| Tensor::from_slice(&channel_mean(values), PUBLISHED_WEIGHTS, &Device::Cpu);
        Ok(Self { parameters, layout, start: row(start)?, spread: row(spread)? })
    }

    /// The mean of \[rows, 3, n\] over the channels, \[rows, n\].
    fn mean(x: &Tensor) -> Result<Tensor> {
        let channel = |c| x.narrow(1, c, 1)?.squeeze(1);
        (channel(0)? + channel(1)?)?.add(&channel(2)?)? / 3.0
    }

    /// What all columns know \[rows, common\], and what each knows \[3 rows, own\].
    fn arrange(&self, code: &Tensor) -> Result<(Tensor, Tensor)> {
        let (rows, layout) = (code.dim(0)?, self.layout);
        let flat = |own: Tensor| own.reshape((rows * 3, layout.own()));
        if layout.channel == 0 {
            return Ok((code.clone(), flat(Self::repeat(code)?)?));
        }
        let shared = code.narrow(1, 0, layout.shared)?;
        let channels = code.narrow(1, layout.shared, 3 * layout.channel)?.reshape((rows, 3, layout.channel))?;
        let common = Tensor::cat(&[&shared, &Self::mean(&channels)?], 1)?;
        let own = Tensor::cat(&[&Self::repeat(&common)?, &channels], 2)?;
        Ok((common, flat(own)?))
    }

    /// \[rows, n\] repeated for each channel, \[rows, 3, n\].
    fn repeat(x: &Tensor) -> Result<Tensor> {
        Tensor::stack(&[x, x, x], 1)
    }
}

impl Model for ZnbrdfModel {
    fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    fn constants(&self) -> Vec<(&'static str, &Tensor)> {
        vec![("start", &self.start), ("spread", &self.spread)]
    }

    /// Inputs \[rows, 3, 576\].
    fn encode(&self, input: &Tensor) -> Result<Tensor> {
        let rows = input.dim(0)?;
        let p = &self.parameters;
        let x = input.reshape((rows * 3, FEATURES))?;
        let embedding = chain(p, "encoder.body", 3, &x, Activation::Silu, Some(Activation::Silu))?;
        let embedding = embedding.reshape((rows, 3, EMBEDDING))?;
        let mean = Self::mean(&embedding)?;
        let shared = p.dense("encoder.shared", &mean, None)?;
        let CodeLayout { channel, .. } = self.layout;
        if channel == 0 {
            return Ok(shared);
        }
        let both = Tensor::cat(&[&embedding, &Self::repeat(&mean)?], D::Minus1)?;
        let channels = p.dense("encoder.channel", &both.reshape((rows * 3, 2 * EMBEDDING))?, None)?;
        Tensor::cat(&[&shared, &channels.reshape((rows, 3 * channel))?], 1)
    }

    fn decode(&self, code: &Tensor) -> Result<Tensor> {
        let rows = code.dim(0)?;
        let p = &self.parameters;
        let (common, own) = self.arrange(code)?;
        let inner = chain(p, "decoder.trunk", 3, &common, Activation::Silu, None)?;
        let width = PUBLISHED_HIDDEN[1];
        let columns = chain(p, "decoder.head", 3, &own, Activation::Silu, None)?.reshape((rows, 3, width + 1))?;
        let kernel = columns.narrow(2, 0, width)?.transpose(1, 2)?.contiguous()?.reshape((rows, 3 * width))?;
        let bias = columns.narrow(2, width, 1)?.reshape((rows, 3))?;
        let offset = Tensor::cat(&[&inner, &kernel, &bias], 1)?;
        offset.broadcast_mul(&self.spread)?.broadcast_add(&self.start)
    }
}

/// Gives the three channels of the output layer their common mean.
pub(crate) fn channel_mean(weights: &[f32]) -> Vec<f32> {
    let mut weights = weights.to_vec();
    for channels in weights[INNER..].chunks_exact_mut(3) {
        let mean = channels.iter().sum::<f32>() / 3.0;
        channels.fill(mean);
    }
    weights
}
