//! The two autoencoders: what they read, how long their codes are, and how they turn one into the other.

mod code_layout;
pub(crate) mod published;
pub(crate) mod znbrdf;

pub(crate) use code_layout::CodeLayout;
pub(crate) use published::PublishedModel;
pub(crate) use znbrdf::{FEATURES, ZnbrdfModel};

use candle_core::{Result, Tensor};

use crate::activation::Activation;
use crate::parameters::Parameters;

/// Numbers in a code, unless asked otherwise.
pub const DIM: usize = 32;
/// Numbers in the longest code.
pub const MAX_DIM: usize = 128;
/// All orders of the colour channels.
pub(crate) const CHANNEL_ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// A trainable autoencoder between rows of inputs and rows of 675 weights.
pub(crate) trait Model {
    /// Trainable tensors.
    fn parameters(&self) -> &Parameters;
    /// Constants that belong to the checkpoint.
    fn constants(&self) -> Vec<(&'static str, &Tensor)>;
    /// Codes \[rows, dim\] of inputs.
    fn encode(&self, input: &Tensor) -> Result<Tensor>;
    /// Weights \[rows, 675\] of codes \[rows, dim\].
    fn decode(&self, code: &Tensor) -> Result<Tensor>;
}

/// Dense layers `name.0`, `name.1`, ... with `activation` between them, and `last` after the last.
pub(crate) fn chain(
    parameters: &Parameters,
    name: &str,
    layers: usize,
    x: &Tensor,
    activation: Activation,
    last: Option<Activation>,
) -> Result<Tensor> {
    let mut x = x.clone();
    for layer in 0..layers {
        let follows = if layer + 1 < layers { Some(activation) } else { last };
        x = parameters.dense(&format!("{name}.{layer}"), &x, follows)?;
    }
    Ok(x)
}

/// Adds the dense layers `name.0`, `name.1`, ... of these widths; the last one starts `last_scale` times smaller.
pub(crate) fn add_chain(
    parameters: &mut Parameters,
    name: &str,
    widths: &[usize],
    last_scale: f32,
    rng: &mut impl rand::Rng,
) -> Result<()> {
    let last = widths.len() - 2;
    for (layer, pair) in widths.windows(2).enumerate() {
        let scale = if layer == last { last_scale } else { 1.0 };
        parameters.add_dense(&format!("{name}.{layer}"), [pair[0], pair[1]], scale, rng)?;
    }
    Ok(())
}
