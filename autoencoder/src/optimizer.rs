//! AdamW whose state can be saved, so that an interrupted training goes on with the same bits.
//!
//! candle's own keeps its moments to itself, and makes a dozen passes over memory.

use std::sync::Mutex;

use candle_core::{CpuStorage, InplaceOp1, Layout, Result, bail};
use nbrdf_core::adam::{Adam, Pace, update};
use rayon::prelude::*;

use crate::locked;
use crate::parameters::Parameters;

const WEIGHT_DECAY: f64 = 1e-2;
/// Gradients longer than this are shortened to it.
const CLIP: f64 = 1.0;
/// Numbers that one task changes.
const PIECE: usize = 16 * 1024;

/// First and second moments of all parameters, in their order.
pub(crate) struct AdamW {
    pub moments: Vec<Adam>,
    pub step: usize,
}

impl AdamW {
    /// At rest.
    pub fn new(parameters: &Parameters) -> Self {
        Self { moments: parameters.iter().map(|parameter| Adam::new(parameter.var.elem_count())).collect(), step: 0 }
    }

    /// One step down the gradients that the last backward pass left; their common norm is clipped first.
    pub fn step(&mut self, parameters: &Parameters, rate: f64) -> Result<()> {
        self.step += 1;
        let square_norm: f64 = parameters.iter().map(|parameter| square_sum(&locked(&parameter.gradient))).sum();
        let shrink = (CLIP / (square_norm.sqrt() + 1e-12)).min(1.0);
        let pace = Pace { step: self.step, rate, shrink, decay: WEIGHT_DECAY };
        for (parameter, moments) in parameters.iter().zip(&mut self.moments) {
            let gradient = locked(&parameter.gradient);
            parameter.var.inplace_op1(&Change { pace, gradient: &gradient, moments: Mutex::new(moments) })?;
        }
        Ok(())
    }
}

/// In pieces of fixed size: the same sum for any number of threads.
fn square_sum(values: &[f32]) -> f64 {
    let piece = |values: &[f32]| {
        let mut lanes = [0.0f32; 32];
        let (whole, rest) = values.as_chunks::<32>();
        for values in whole {
            lanes.iter_mut().zip(values).for_each(|(sum, v)| *sum += v * v);
        }
        lanes.iter().chain(&[rest.iter().map(|v| v * v).sum()]).map(|&sum| f64::from(sum)).sum()
    };
    let pieces: Vec<f64> = values.par_chunks(PIECE).map(piece).collect();
    pieces.iter().sum()
}

struct Change<'a> {
    pace: Pace,
    gradient: &'a [f32],
    moments: Mutex<&'a mut Adam>,
}

impl InplaceOp1 for Change<'_> {
    fn name(&self) -> &'static str {
        "adamw"
    }

    fn cpu_fwd(&self, values: &mut CpuStorage, layout: &Layout) -> Result<()> {
        let (CpuStorage::F32(values), Some((start, end))) = (values, layout.contiguous_offsets()) else {
            bail!("expected f32 without gaps")
        };
        let mut moments = locked(&self.moments);
        let Adam { mean, square } = &mut **moments;
        let moments = mean.par_chunks_mut(PIECE).zip(square.par_chunks_mut(PIECE));
        let values = values[start..end].par_chunks_mut(PIECE);
        values.zip(self.gradient.par_chunks(PIECE)).zip(moments).for_each(|((values, gradient), (mean, square))| {
            update(&self.pace, gradient, mean, square, values);
        });
        Ok(())
    }
}
