//! Forward pass over blocks of directions.
//!
//! The weights are packed in the order of the loops, activations stay in the first-level cache, and directions become
//! network inputs in the same blocks. Every lane sees the same operations in the same order whatever the width of the
//! vectors: AVX2, AVX-512 and NEON give the same bits, the portable path (no fused multiply-add) differs in the last.

pub(crate) mod dense;
mod half_diff;
pub(crate) mod outer;
mod packed;

use std::cell::RefCell;

use pulp::{Simd, WithSimd};

use super::INPUTS;
use crate::brdf::Azimuth;
use crate::simd::{InstructionSet, LANES, Lanes, exp_minus_one};
use crate::{Directions, Rgb};
use dense::dense;

pub(crate) use half_diff::{Block, ORDER, half_diff};
pub use packed::Live;
pub(crate) use packed::Packed;

/// The activations of one block.
#[derive(Clone, Debug)]
pub(crate) struct Activations {
    pub first: Vec<Lanes>,
    pub second: Vec<Lanes>,
    /// exp(y) − 1, not clamped.
    pub output: [Lanes; 3],
}

impl Activations {
    pub const EMPTY: Self = Self { first: Vec::new(), second: Vec::new(), output: [Lanes::ZERO; 3] };

    /// For these hidden widths; allocates only where more are needed than ever before.
    pub fn resize(&mut self, [first, second]: [usize; 2]) {
        self.first.resize(first, Lanes::ZERO);
        self.second.resize(second, Lanes::ZERO);
    }

    /// All three layers; the widths must be those of the network.
    #[inline(always)]
    pub fn forward<S: Simd>(&mut self, simd: S, network: &Packed, inputs: &[Lanes; INPUTS]) {
        let weights = network.weights();
        let weights = dense::<S, true>(simd, &inputs[..network.live().inputs()], weights, &mut self.first);
        let weights = dense::<S, true>(simd, &self.first, weights, &mut self.second);
        dense::<S, false>(simd, &self.second, weights, &mut self.output);
        for lanes in &mut self.output {
            for y in lanes.vectors_mut::<S>() {
                *y = exp_minus_one(simd, *y);
            }
        }
    }

    /// The first lanes, black where a direction is below the surface.
    #[inline(always)]
    fn store<S: Simd>(&mut self, simd: S, above: u32, sign: Sign, out: &mut [Rgb]) {
        if sign == Sign::Clamped {
            let zero = simd.splat_f32s(0.0);
            // Plain loops: a closure in an iterator's adapter may be compiled without the vectors.
            for lanes in &mut self.output {
                for f in lanes.vectors_mut::<S>() {
                    *f = simd.max_f32s(*f, zero);
                }
            }
        }
        let [r, g, b] = &self.output;
        let value = |lane: usize| Rgb([r.0[lane], g.0[lane], b.0[lane]]);
        match (above, <&mut [Rgb; LANES]>::try_from(&mut *out)) {
            (u32::MAX, Ok(out)) => out.iter_mut().enumerate().for_each(|(lane, out)| *out = value(lane)),
            _ => {
                for (lane, out) in out.iter_mut().enumerate() {
                    *out = if (above >> lane) & 1 == 1 { value(lane) } else { Rgb::BLACK };
                }
            }
        }
    }
}

thread_local! {
    /// Each thread's activations: evaluation allocates nothing.
    static SCRATCH: RefCell<Activations> = const { RefCell::new(Activations::EMPTY) };
}

/// What becomes of values below 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sign {
    /// They stay.
    Kept,
    /// They become 0.
    Clamped,
}

/// Where network inputs come from.
#[derive(Clone, Copy)]
enum Source<'a> {
    /// Pairs, converted block by block.
    Directions(&'a [Directions], Azimuth),
    /// Blocks that were converted before.
    Blocks(&'a [Block]),
}

struct Evaluate<'a> {
    network: &'a Packed,
    source: Source<'a>,
    sign: Sign,
    out: &'a mut [Rgb],
    activations: &'a mut Activations,
}

impl WithSimd for Evaluate<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { network, source, sign, out, activations } = self;
        let mut converted = Block::EMPTY;
        for (index, out) in out.chunks_mut(LANES).enumerate() {
            let block = match source {
                Source::Blocks(blocks) => &blocks[index],
                Source::Directions(at, azimuth) => {
                    converted.fill(simd, &at[index * LANES..][..out.len()], azimuth);
                    &converted
                }
            };
            activations.forward(simd, network, &block.inputs);
            activations.store(simd, block.above, sign, out);
        }
    }
}

fn evaluate(set: InstructionSet, network: &Packed, source: Source, sign: Sign, out: &mut [Rgb]) {
    SCRATCH.with_borrow_mut(|activations| {
        activations.resize(network.hidden());
        set.run(Evaluate { network, source, sign, out, activations });
    });
}

/// exp(y) − 1 for every pair of directions; zero below the horizon.
///
/// # Panics
/// If `at` and `out` differ in length (a bug of the caller).
pub(crate) fn forward(
    set: InstructionSet,
    network: &Packed,
    sign: Sign,
    (at, azimuth): (&[Directions], Azimuth),
    out: &mut [Rgb],
) {
    assert_eq!(at.len(), out.len(), "one output per pair of directions");
    evaluate(set, network, Source::Directions(at, azimuth), sign, out);
}

/// As [`forward`], from blocks of prepared pairs, the last of which may not be full.
///
/// # Panics
/// If there are not as many blocks as `out` needs (a bug of the caller).
pub(crate) fn forward_blocks(set: InstructionSet, network: &Packed, sign: Sign, blocks: &[Block], out: &mut [Rgb]) {
    assert_eq!(blocks.len(), out.len().div_ceil(LANES), "one output per pair of directions");
    evaluate(set, network, Source::Blocks(blocks), sign, out);
}

struct Prepare<'a> {
    at: &'a [Directions],
    azimuth: Azimuth,
    blocks: &'a mut [Block],
}

impl WithSimd for Prepare<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (at, block) in self.at.chunks(LANES).zip(self.blocks) {
            block.fill(simd, at, self.azimuth);
        }
    }
}

/// Pairs of directions as network inputs.
pub(crate) fn blocks(at: &[Directions], azimuth: Azimuth) -> Vec<Block> {
    blocks_with(InstructionSet::fastest(), at, azimuth)
}

fn blocks_with(set: InstructionSet, at: &[Directions], azimuth: Azimuth) -> Vec<Block> {
    let mut blocks = vec![Block::EMPTY; at.len().div_ceil(LANES)];
    set.run(Prepare { at, azimuth, blocks: &mut blocks });
    blocks
}

/// The slow, obvious loop in f64 that the kernel is tested against.
#[cfg(test)]
pub(crate) fn forward_plainly(network: &super::Nbrdf, crate::HalfDiff { half, diff }: crate::HalfDiff) -> [f64; 3] {
    let layers = network.layout().layers;
    let crate::Vec3 { x, y, z } = half;
    let mut values = [x, y, z, diff.x, diff.y, diff.z].map(f64::from).to_vec();
    for (index, (kernel, bias)) in layers.into_iter().enumerate() {
        let (kernel, bias) = (&network.weights[kernel], &network.weights[bias]);
        let sum = |j: usize| -> f64 {
            values.iter().enumerate().map(|(i, v)| v * f64::from(kernel[i * bias.len() + j])).sum::<f64>()
        };
        values = (0..bias.len()).map(|j| f64::from(bias[j]) + sum(j)).collect();
        if index < 2 {
            values.iter_mut().for_each(|v| *v = v.max(0.0));
        }
    }
    std::array::from_fn(|channel| values[channel].exp_m1())
}

#[cfg(test)]
mod tests;
