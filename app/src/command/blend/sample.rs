//! A place on a path, and what it is called.

use anyhow::Result;
use nbrdf_core::{Warning, Weights};

/// A point of a path, and its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Barycentric weights.
    pub weights: Weights,
    /// The number asked for, `0.125`, between two ends; all that were asked for, in order, between more.
    pub label: String,
    /// That it lies beyond the ends; points of a curve through them do not, small negative weights or not.
    pub warning: Option<Warning>,
}

impl Sample {
    /// Of one place among evenly spread ones: two decimals tell them apart.
    pub(super) fn spread(weights: Vec<f32>) -> Result<Self> {
        let label = match weights.as_slice() {
            [_, t] => number(*t),
            more => joined(Weights::normalized(more.to_vec())?.as_slice(), number),
        };
        Self::new(weights, label)
    }

    /// Of one place that is called this.
    pub(super) fn new(weights: Vec<f32>, label: String) -> Result<Self> {
        let weights = Weights::normalized(weights)?;
        let beyond = weights.beyond();
        let warning = (beyond > f32::EPSILON).then_some(Warning::Extrapolated { beyond });
        Ok(Self { weights, label, warning })
    }

    /// What stands above its column.
    pub fn heading(&self) -> String {
        if self.weights.as_slice().len() == 2 && !self.label.contains(':') {
            format!("t = {}", self.label)
        } else {
            self.label.clone()
        }
    }
}

/// Two decimals, no idle zeros.
pub(super) fn number(value: f32) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

/// As many decimals as it takes to tell the number: what was typed.
pub(super) fn exact(value: f32) -> String {
    // Without the sign of -0.
    (value + 0.0).to_string()
}

/// Weights side by side.
pub(super) fn joined(weights: &[f32], shown: fn(f32) -> String) -> String {
    weights.iter().map(|weight| shown(*weight)).collect::<Vec<_>>().join(" : ")
}
