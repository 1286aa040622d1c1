//! A model as a point of a chart: what it costs, and how close it comes.

use std::collections::BTreeMap;

use nbrdf_core::metric::Spread;
use serde::{Deserialize, Serialize};

use super::quality::Quality;
use super::times::Times;
use crate::catalog::{Family, RepresentationEntry};

/// How an error is spread over materials.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// Arithmetic mean.
    pub mean: f64,
    /// A tenth of the materials are below.
    pub p10: f64,
    /// A tenth are above.
    pub p90: f64,
    /// The largest.
    pub max: f64,
}

impl Band {
    /// Of these values; none of no values.
    pub fn of(values: &[f64]) -> Option<Self> {
        let spread = |higher_is_better| Spread::new(values.iter().map(|&v| ("", v)), higher_is_better);
        let Spread { mean, p90, max, .. } = spread(false)?;
        // Where higher is better, nine in ten reach it.
        Some(Self { mean, p10: spread(true)?.p90, p90, max })
    }
}

/// A model, measured.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Point {
    /// Name in the catalog; that of a code with its length.
    pub name: String,
    /// How its codes are made.
    pub variant: String,
    /// Which file it is of, where another point has its name and variant.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// What it keeps.
    pub family: Family,
    /// What it took: the median over runs.
    #[serde(flatten)]
    pub times: Times,
    /// Bytes of one material.
    pub bytes: usize,
    /// Bytes that all materials share.
    pub shared_bytes: usize,
    /// By key of the metric.
    pub error: BTreeMap<String, Band>,
    /// What it took in each run; nothing of a single run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by_run: Vec<Times>,
}

impl Point {
    /// Of what was measured of a line in the catalog in these runs; none of no run.
    pub fn of(entry: &RepresentationEntry, quality: &Quality, runs: Vec<Times>) -> Option<Self> {
        let values =
            |key: &str| quality.materials.iter().filter_map(|own| own.figures.get(key).copied()).collect::<Vec<_>>();
        let band = |key: &str| Some((key.to_owned(), Band::of(&values(key))?));
        Some(Self {
            name: if entry.name == "znbrdf" { format!("znbrdf_{}", quality.dim) } else { entry.name.to_owned() },
            variant: entry.variant.name().to_owned(),
            file: None,
            family: entry.family,
            times: Times::median(&runs)?,
            bytes: quality.bytes,
            shared_bytes: quality.shared_bytes,
            error: METRICS.iter().filter_map(|key| band(key)).collect(),
            by_run: if runs.len() > 1 { runs } else { Vec::new() },
        })
    }

    /// What it took in a run.
    pub fn run(&self, run: usize) -> Times {
        self.by_run.get(run).copied().unwrap_or(self.times)
    }

    /// Whether it could have been measured: printable words, finite numbers, none below 0, times above.
    pub fn is_sound(&self) -> bool {
        let is_word = |text: &str| (1..=64).contains(&text.chars().count()) && !text.chars().any(char::is_control);
        let is_error =
            |band: &Band| [band.mean, band.p10, band.p90, band.max].iter().all(|v| v.is_finite() && *v >= 0.0);
        is_word(&self.name)
            && is_word(&self.variant)
            && self.file.as_deref().is_none_or(is_word)
            && self.by_run.iter().chain([&self.times]).all(Times::is_sound)
            && self.error.values().all(is_error)
    }

    /// Its name, with how its codes are made where that is not the plain way, and with its file.
    pub fn title(&self) -> String {
        let mut title = self.name.clone();
        if let "refined" | "feed_forward" = self.variant.as_str() {
            title += &format!(" {}", self.variant.replace('_', "-"));
        }
        if let Some(file) = &self.file {
            title += &format!(" ({file})");
        }
        title
    }
}

/// Errors that a chart can show: all of which less is better.
pub const METRICS: [&str; 6] =
    ["studio_flip", "studio_delta_e_itp", "point_flip", "point_delta_e_itp", "log_error", "relative_log"];

/// A metric of [`METRICS`] for people.
pub fn title_of(metric: &str) -> String {
    match metric.split_once('_') {
        Some((light @ ("studio" | "point"), error)) => {
            let error = match error {
                "flip" => "FLIP",
                "delta_e_itp" => "ΔE_ITP",
                other => other,
            };
            format!("{error}, {light} light")
        }
        _ => metric.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_holds_eight_of_ten() {
        let band = Band::of(&(0..=10).map(f64::from).collect::<Vec<_>>()).unwrap();
        assert_eq!((band.mean, band.p10, band.p90, band.max), (5.0, 1.0, 9.0, 10.0));
        assert!(Band::of(&[]).is_none());
    }
}
