//! Ours, as described in `model/znbrdf.rs`.

use std::cell::Cell;

use nbrdf_core::dense::{Bias, Dense};
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};

use super::Inference;
use super::chain::{Chain, dense};
use crate::activation::Activation;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::model::CodeLayout;
use crate::model::znbrdf::{BODY, EMBEDDING, channel_mean, head, trunk};

/// Weights of one column of the output layer, and its bias.
const COLUMN: usize = PUBLISHED_HIDDEN[1] + 1;
/// Weights of the first two layers.
const INNER: usize = PUBLISHED_WEIGHTS - 3 * COLUMN;

pub(super) struct ZnbrdfInference {
    layout: CodeLayout,
    body: Chain,
    shared: Dense,
    /// None where codes are grey.
    channel: Option<Dense>,
    trunk: Chain,
    head: Chain,
    start: Vec<f32>,
    spread: Vec<f32>,
}

thread_local! {
    /// Each thread's arranged code and decoded parts: inner weights, and three columns.
    static PARTS: Cell<Vec<f32>> = const { Cell::new(Vec::new()) };
}

impl ZnbrdfInference {
    pub fn new(file: &Checkpoint) -> Result<Self, CheckpointError> {
        let layout = CodeLayout::of(file)?;
        let channel = || dense(file, "encoder.channel", [2 * EMBEDDING, layout.channel]);
        Ok(Self {
            layout,
            body: Chain::new(file, "encoder.body", &BODY, Activation::Silu)?,
            shared: dense(file, "encoder.shared", [EMBEDDING, layout.shared])?,
            channel: (layout.channel > 0).then(channel).transpose()?,
            trunk: Chain::new(file, "decoder.trunk", &trunk(layout), Activation::Silu)?,
            head: Chain::new(file, "decoder.head", &head(layout), Activation::Silu)?,
            start: channel_mean(file.tensor("start", &[PUBLISHED_WEIGHTS])?),
            spread: channel_mean(file.tensor("spread", &[PUBLISHED_WEIGHTS])?),
        })
    }

    /// Numbers of an arranged code.
    const fn arranged(&self) -> usize {
        self.layout.common() + 3 * self.layout.own()
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

/// What the trunk reads \[common\] and what the three columns read \[3, own\], one after the other; linear in the code.
fn arrange(layout: CodeLayout, code: &[f32], arranged: &mut [f32]) {
    let CodeLayout { shared, channel } = layout;
    let (common, own) = arranged.split_at_mut(layout.common());
    let channels = &code[shared..];
    common[..shared].copy_from_slice(&code[..shared]);
    for (k, mean) in common[shared..].iter_mut().enumerate() {
        *mean = (channels[k] + channels[channel + k] + channels[2 * channel + k]) / 3.0;
    }
    for (c, own) in own.chunks_exact_mut(layout.own()).enumerate() {
        own[..common.len()].copy_from_slice(common);
        own[common.len()..].copy_from_slice(&channels[channel * c..channel * (c + 1)]);
    }
}

impl Inference for ZnbrdfInference {
    fn dim(&self) -> usize {
        self.layout.dim()
    }

    fn encode(&self, input: &[f32], code: &mut [f32]) {
        let mut embedding = vec![0.0; 3 * EMBEDDING];
        self.body.apply(input, &mut embedding);
        nbrdf_core::dense::silu(&mut embedding, None);
        let (a, rest) = embedding.split_at(EMBEDDING);
        let (b, c) = rest.split_at(EMBEDDING);
        let mean: Vec<f32> = a.iter().zip(b.iter().zip(c)).map(|(a, (b, c))| (a + b + c) / 3.0).collect();
        let (shared, channels) = code.split_at_mut(self.layout.shared);
        self.shared.apply(&mean, Bias::Added, shared);
        let Some(channel) = &self.channel else { return };
        let both: Vec<f32> = [a, b, c].into_iter().flat_map(|own| own.iter().chain(&mean)).copied().collect();
        channel.apply(&both, Bias::Added, channels);
    }

    fn decoder_bytes(&self) -> usize {
        self.trunk.bytes() + self.head.bytes() + size_of_val(&*self.start) + size_of_val(&*self.spread)
    }

    fn decode(&self, code: &[f32], weights: &mut [f32]) {
        let (common, arranged) = (self.layout.common(), self.arranged());
        let mut parts = PARTS.take();
        parts.resize(arranged + INNER + 3 * COLUMN, 0.0);
        let (read, decoded) = parts.split_at_mut(arranged);
        let (inner, columns) = decoded.split_at_mut(INNER);
        arrange(self.layout, code, read);
        self.trunk.apply(&read[..common], inner);
        self.head.apply(&read[common..], columns);
        weights.copy_from_slice(&self.start);
        self.spread_out(inner, columns, weights);
        PARTS.set(parts);
    }

    fn linearize(&self, code: &[f32], weights: &mut [f32], by_number: &mut [f32]) {
        let (dim, common, arranged) = (self.layout.dim(), self.layout.common(), self.arranged());
        let mut read = vec![0.0; arranged];
        arrange(self.layout, code, &mut read);
        let (mut common_moved, mut own_moved) = (Vec::new(), Vec::new());
        let (mut unit, mut moved) = (vec![0.0; dim], vec![0.0; arranged]);
        for number in 0..dim {
            unit[number] = 1.0;
            arrange(self.layout, &unit, &mut moved);
            unit[number] = 0.0;
            common_moved.extend_from_slice(&moved[..common]);
            own_moved.extend_from_slice(&moved[common..]);
        }
        let (mut inner, mut columns) = (vec![0.0; INNER], vec![0.0; 3 * COLUMN]);
        let (mut inner_moved, mut columns_moved) = (vec![0.0; dim * INNER], vec![0.0; dim * 3 * COLUMN]);
        self.trunk.linearize(&read[..common], &common_moved, &mut inner, &mut inner_moved);
        self.head.linearize(&read[common..], &own_moved, &mut columns, &mut columns_moved);
        weights.copy_from_slice(&self.start);
        self.spread_out(&inner, &columns, weights);
        by_number.fill(0.0);
        let moved = inner_moved.chunks_exact(INNER).zip(columns_moved.chunks_exact(3 * COLUMN));
        for (row, (inner, columns)) in by_number.chunks_exact_mut(PUBLISHED_WEIGHTS).zip(moved) {
            self.spread_out(inner, columns, row);
        }
    }
}
