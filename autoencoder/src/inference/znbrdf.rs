//! Ours, as described in `model/znbrdf.rs`.

use std::cell::Cell;

use nbrdf_core::dense::{Bias, Dense};
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};

use super::Inference;
use super::chain::{Chain, dense};
use crate::activation::Activation;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::model::DIM;
use crate::model::znbrdf::{BODY, CHANNEL, EMBEDDING, HEAD, SHARED, TRUNK, channel_mean};

/// Weights of one column of the output layer, and its bias.
const COLUMN: usize = PUBLISHED_HIDDEN[1] + 1;
/// Weights of the first two layers.
const INNER: usize = PUBLISHED_WEIGHTS - 3 * COLUMN;
/// What every column knows, and what one column knows.
const COMMON: usize = SHARED + CHANNEL;
const OWN: usize = COMMON + CHANNEL;

pub(super) struct ZnbrdfInference {
    body: Chain,
    shared: Dense,
    channel: Dense,
    trunk: Chain,
    head: Chain,
    start: Vec<f32>,
    spread: Vec<f32>,
}

thread_local! {
    /// Each thread's decoded parts: inner weights, and three columns.
    static PARTS: Cell<Vec<f32>> = const { Cell::new(Vec::new()) };
}

impl ZnbrdfInference {
    pub fn new(file: &Checkpoint) -> Result<Self, CheckpointError> {
        Ok(Self {
            body: Chain::new(file, "encoder.body", &BODY, Activation::Silu)?,
            shared: dense(file, "encoder.shared", [EMBEDDING, SHARED])?,
            channel: dense(file, "encoder.channel", [2 * EMBEDDING, CHANNEL])?,
            trunk: Chain::new(file, "decoder.trunk", &TRUNK, Activation::Silu)?,
            head: Chain::new(file, "decoder.head", &HEAD, Activation::Silu)?,
            start: channel_mean(file.tensor("start", &[PUBLISHED_WEIGHTS])?),
            spread: channel_mean(file.tensor("spread", &[PUBLISHED_WEIGHTS])?),
        })
    }

    /// `weights` += spread · decoded parts.
    fn spread_out(&self, inner: &[f32], columns: &[f32], weights: &mut [f32]) {
        let place = |column: usize, row: usize| INNER + 3 * row + column;
        for (w, (spread, part)) in weights.iter_mut().zip(self.spread.iter().zip(inner)) {
            *w += spread * part;
        }
        for (column, parts) in columns.chunks_exact(COLUMN).enumerate() {
            for (row, part) in parts.iter().enumerate() {
                weights[place(column, row)] += self.spread[place(column, row)] * part;
            }
        }
    }
}

/// What the trunk reads \[24\] and what the three columns read \[3, 28\]; linear in the code.
fn arrange(code: &[f32]) -> ([f32; COMMON], [f32; 3 * OWN]) {
    let channels = &code[SHARED..];
    let mut common = [0.0; COMMON];
    common[..SHARED].copy_from_slice(&code[..SHARED]);
    for (k, mean) in common[SHARED..].iter_mut().enumerate() {
        *mean = (channels[k] + channels[CHANNEL + k] + channels[2 * CHANNEL + k]) / 3.0;
    }
    let mut own = [0.0; 3 * OWN];
    for (own, channel) in own.chunks_exact_mut(OWN).zip(channels.chunks_exact(CHANNEL)) {
        own[..COMMON].copy_from_slice(&common);
        own[COMMON..].copy_from_slice(channel);
    }
    (common, own)
}

impl Inference for ZnbrdfInference {
    fn encode(&self, input: &[f32], code: &mut [f32]) {
        let mut embedding = vec![0.0; 3 * EMBEDDING];
        self.body.apply(input, &mut embedding);
        nbrdf_core::dense::silu(&mut embedding, None);
        let (a, rest) = embedding.split_at(EMBEDDING);
        let (b, c) = rest.split_at(EMBEDDING);
        let mean: Vec<f32> = a.iter().zip(b.iter().zip(c)).map(|(a, (b, c))| (a + b + c) / 3.0).collect();
        self.shared.apply(&mean, Bias::Added, &mut code[..SHARED]);
        let both: Vec<f32> = [a, b, c].into_iter().flat_map(|own| own.iter().chain(&mean)).copied().collect();
        self.channel.apply(&both, Bias::Added, &mut code[SHARED..]);
    }

    fn decoder_bytes(&self) -> usize {
        self.trunk.bytes() + self.head.bytes() + size_of_val(&*self.start) + size_of_val(&*self.spread)
    }

    fn decode(&self, code: &[f32], weights: &mut [f32]) {
        let (common, own) = arrange(code);
        let mut parts = PARTS.take();
        parts.resize(INNER + 3 * COLUMN, 0.0);
        let (inner, columns) = parts.split_at_mut(INNER);
        self.trunk.apply(&common, inner);
        self.head.apply(&own, columns);
        weights.copy_from_slice(&self.start);
        self.spread_out(inner, columns, weights);
        PARTS.set(parts);
    }

    fn linearize(&self, code: &[f32], weights: &mut [f32], by_number: &mut [f32]) {
        let (common, own) = arrange(code);
        let units = (0..DIM).map(|i| arrange(&std::array::from_fn::<f32, DIM, _>(|j| f32::from(u8::from(i == j)))));
        let (common_moved, own_moved): (Vec<_>, Vec<_>) = units.unzip();
        let (mut inner, mut columns) = (vec![0.0; INNER], vec![0.0; 3 * COLUMN]);
        let (mut inner_moved, mut columns_moved) = (vec![0.0; DIM * INNER], vec![0.0; DIM * 3 * COLUMN]);
        self.trunk.linearize(&common, common_moved.as_flattened(), &mut inner, &mut inner_moved);
        self.head.linearize(&own, own_moved.as_flattened(), &mut columns, &mut columns_moved);
        weights.copy_from_slice(&self.start);
        self.spread_out(&inner, &columns, weights);
        by_number.fill(0.0);
        let moved = inner_moved.chunks_exact(INNER).zip(columns_moved.chunks_exact(3 * COLUMN));
        for (row, (inner, columns)) in by_number.chunks_exact_mut(PUBLISHED_WEIGHTS).zip(moved) {
            self.spread_out(inner, columns, row);
        }
    }
}
