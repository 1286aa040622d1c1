//! The few numbers that stand for a material, and which model they belong to.

use serde::{Deserialize, Serialize};

use super::DecodeError;

/// A code and where it comes from; its JSON form is what `nbrdf encode` writes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Code {
    /// Version of the JSON form.
    pub schema: u32,
    /// Name of the representation.
    pub model: String,
    /// Hash of what the representation has learned.
    pub checkpoint: String,
    /// The numbers.
    pub code: Vec<f32>,
    /// Name of the encoded material, where known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// `log_error` that the decoded code is expected to have, where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expected_log_error: Option<f64>,
    /// Distance to the code of the nearest training material, in distances among these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
}

impl Code {
    /// Version of the JSON form that this software writes and reads.
    pub const SCHEMA: u32 = 1;

    /// A code without a material's name.
    pub fn new(model: &str, checkpoint: &str, code: Vec<f32>) -> Self {
        Self {
            schema: Self::SCHEMA,
            model: model.into(),
            checkpoint: checkpoint.into(),
            code,
            material: None,
            expected_log_error: None,
            distance: None,
        }
    }

    /// The numbers, if this is a code of that model, checkpoint and length.
    pub fn checked(&self, model: &str, checkpoint: &str, dim: usize) -> Result<&[f32], DecodeError> {
        if self.model != model {
            return Err(DecodeError::Model { expected: model.into(), found: self.model.clone() });
        }
        if self.checkpoint != checkpoint {
            return Err(DecodeError::Checkpoint { expected: checkpoint.into(), found: self.checkpoint.clone() });
        }
        check_numbers(model, &self.code, dim)
    }
}

/// The numbers, if there are as many as the model's codes have and all are finite.
pub fn check_numbers<'a>(model: &str, numbers: &'a [f32], dim: usize) -> Result<&'a [f32], DecodeError> {
    if numbers.len() != dim {
        return Err(DecodeError::Length { model: model.into(), expected: dim, found: numbers.len() });
    }
    match numbers.iter().enumerate().find(|(_, v)| !v.is_finite()) {
        Some((index, &value)) => Err(DecodeError::NotFinite { index, value }),
        None => Ok(numbers),
    }
}
