//! Dense layers one after the other, forwards and differentiated.

use std::cell::Cell;

use nbrdf_core::dense::{Bias, Dense};

use crate::activation::Activation;
use crate::checkpoint::{Checkpoint, CheckpointError};

/// Dense layers with an activation between them.
pub(crate) struct Chain {
    layers: Vec<Dense>,
    activation: Activation,
}

thread_local! {
    /// Each thread's rows between two layers.
    static BETWEEN: Cell<[Vec<f32>; 2]> = const { Cell::new([Vec::new(), Vec::new()]) };
}

impl Chain {
    /// Layers `name.0`, `name.1`, ... of these widths.
    pub fn new(
        file: &Checkpoint,
        name: &str,
        widths: &[usize],
        activation: Activation,
    ) -> Result<Self, CheckpointError> {
        let layer = |(index, pair): (usize, &[usize])| dense(file, &format!("{name}.{index}"), [pair[0], pair[1]]);
        let layers = widths.windows(2).enumerate().map(layer).collect::<Result<_, _>>()?;
        Ok(Self { layers, activation })
    }

    /// Bytes of all layers.
    pub fn bytes(&self) -> usize {
        self.layers.iter().map(Dense::bytes).sum()
    }

    /// `out` \[rows, outputs\] of `x` \[rows, inputs\].
    pub fn apply(&self, x: &[f32], out: &mut [f32]) {
        let Some((last, inner)) = self.layers.split_last() else { return };
        let rows = out.len() / last.outputs();
        let [mut from, mut to] = BETWEEN.take();
        from.clear();
        from.extend_from_slice(x);
        for layer in inner {
            to.resize(rows * layer.outputs(), 0.0);
            layer.apply(&from, Bias::Added, &mut to);
            self.activation.apply(&mut to, None);
            std::mem::swap(&mut from, &mut to);
        }
        last.apply(&from, Bias::Added, out);
        BETWEEN.set([from, to]);
    }

    /// As [`apply`](Self::apply), with `moved` \[changes, rows, inputs\] carried to `out_moved` \[changes, rows, outputs\].
    pub fn linearize(&self, x: &[f32], moved: &[f32], out: &mut [f32], out_moved: &mut [f32]) {
        let Some((last, inner)) = self.layers.split_last() else { return };
        let (mut x, mut moved) = (x.to_vec(), moved.to_vec());
        for layer in inner {
            let next = |from: &[f32], bias| {
                let mut to = vec![0.0; from.len() / layer.inputs() * layer.outputs()];
                layer.apply(from, bias, &mut to);
                to
            };
            (x, moved) = (next(&x, Bias::Added), next(&moved, Bias::LeftOut));
            let mut slopes = vec![0.0; x.len()];
            self.activation.apply(&mut x, Some(&mut slopes));
            for change in moved.chunks_exact_mut(slopes.len()) {
                change.iter_mut().zip(&slopes).for_each(|(change, slope)| *change *= slope);
            }
        }
        last.apply(&x, Bias::Added, out);
        last.apply(&moved, Bias::LeftOut, out_moved);
    }
}

/// The layer `name` of a checkpoint.
pub(crate) fn dense(file: &Checkpoint, name: &str, [inputs, outputs]: [usize; 2]) -> Result<Dense, CheckpointError> {
    let weight = file.tensor(&format!("{name}.weight"), &[outputs, inputs])?;
    Ok(Dense::new(weight, file.tensor(&format!("{name}.bias"), &[outputs])?))
}
