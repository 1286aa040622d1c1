//! How far a code may be trusted: the error it is expected to have, and how far it is from what training has seen.

use autoencoder::Autoencoder;
use nbrdf_core::metric::log_error_estimate;
use nbrdf_core::representation::DecodeError;
use nbrdf_core::{Brdf, Code, Material, Warning};
use serde::Serialize;

/// Expected `log_error` beyond which a code does not carry its material, whatever made it: nearly twice the largest error
/// among the validation materials with ZNBRDF.
const CARRIED: f64 = 0.015;

/// What is known of a code when it has just been made.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Trust {
    /// Expected `log_error`, from directions that no metric asks.
    pub expected_log_error: f64,
    /// Distance to the nearest training material's code; 1 is how far these are from each other. None where nothing is
    /// remembered of training.
    pub distance: Option<f64>,
    /// Numbers in the code.
    #[serde(skip)]
    pub numbers: usize,
}

impl Trust {
    /// Of the code of `material` and what it decodes to.
    pub fn of(material: &Material, code: &Code, decoded: &dyn Brdf, known: &Autoencoder) -> Result<Self, DecodeError> {
        let expected_log_error = log_error_estimate(material.brdf.as_ref(), decoded);
        Ok(Self { expected_log_error, distance: known.distance(code)?, numbers: code.code.len() })
    }

    /// That the code does not carry its material.
    pub fn warning(&self) -> Option<Warning> {
        let (numbers, expected) = (self.numbers, self.expected_log_error);
        // No number is no trust.
        let is_carried = expected <= CARRIED;
        (!is_carried).then_some(Warning::NotCarried { numbers, expected, usual: CARRIED })
    }

    /// What to tell then; `can_refine` if a closer code of the same representation may be asked for.
    pub fn advice(&self, material: &str, can_refine: bool) -> Option<String> {
        let or_refine = if can_refine { ", or try --refine" } else { "" };
        Some(format!("{material}: {}: keep the network{or_refine}", self.warning()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refining_is_advised_only_where_it_is_still_to_be_had() {
        let of = |expected_log_error| Trust { expected_log_error, distance: None, numbers: 32 };
        assert_eq!(of(CARRIED).advice("m", true), None);
        for unsure in [1.0, f64::NAN] {
            assert!(of(unsure).advice("m", true).is_some_and(|advice| advice.contains("--refine")));
            assert!(of(unsure).advice("m", false).is_some_and(|advice| !advice.contains("--refine")));
        }
    }
}
