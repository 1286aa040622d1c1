//! One method under one hazard.

use nbrdf_core::stress::{Group, Hazard, Verdict};
use serde::{Deserialize, Serialize};

/// How a method bears a hazard.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Cell {
    /// Name of the hazard.
    pub hazard: String,
    /// Its kind.
    pub group: Group,
    /// Name of the method.
    pub method: String,
    /// How its codes are made, where that is to be told.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub variant: Option<String>,
    /// Of the worst example; none where the method refuses all of them, or is not a number.
    pub value: Option<f64>,
    /// From where on it is worse.
    pub threshold: Threshold,
    /// How it is borne.
    pub verdict: Verdict,
    /// Examples.
    pub count: usize,
    /// Share of the examples that do not hold.
    pub share: f64,
    /// Names of the worst examples, the worst first.
    pub worst: Vec<String>,
    /// Kinds of warnings that come with the worst example.
    pub warnings: Vec<String>,
    /// What else there is to say: the error of a method that refuses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The worst example, as PNG in base 64; left out of reports on standard output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
}

/// Largest values at which a method holds, and at which it does not fail yet.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Threshold {
    /// Largest value that holds.
    pub holds: f64,
    /// Largest value that only degrades.
    pub fails: f64,
}

impl Threshold {
    pub(super) const fn of(hazard: &Hazard) -> Self {
        Self { holds: hazard.holds, fails: hazard.fails }
    }
}

impl Cell {
    /// Method and, where it has several, variant.
    pub fn title(&self) -> String {
        match &self.variant {
            Some(variant) => format!("{} ({})", self.method, variant.replace('_', " ")),
            None => self.method.clone(),
        }
    }

    /// Whether this is what the hazard gives: its thresholds, and the verdict of the value.
    pub fn is_sound(&self, hazard: &Hazard) -> bool {
        let is_judged = match self.value {
            Some(value) => hazard.verdict(value) == self.verdict,
            None => matches!(self.verdict, Verdict::Fails | Verdict::Refuses),
        };
        is_judged && [self.threshold.holds, self.threshold.fails] == [hazard.holds, hazard.fails]
    }

    /// Whether the method fails and nothing is said.
    pub fn is_silent(&self) -> bool {
        self.verdict == Verdict::Fails && self.warnings.is_empty()
    }
}
