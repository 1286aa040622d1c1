//! A model as a point of a chart: what it costs, and how close it comes.

use std::collections::BTreeMap;

use nbrdf_core::metric::Spread;
use serde::{Deserialize, Serialize};

use super::quality::Quality;
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
    /// What it keeps.
    pub family: Family,
    /// Nanoseconds per evaluation, one thread.
    pub ns: f64,
    /// How many times the plain loop over the weights takes as long.
    pub ratio_to_reference_loop: f64,
    /// Bytes of one material.
    pub bytes: usize,
    /// Bytes that all materials share.
    pub shared_bytes: usize,
    /// Seconds to encode one, the median.
    pub encode_s: f64,
    /// By key of the metric.
    pub error: BTreeMap<String, Band>,
}

impl Point {
    /// Of what was measured of a line in the catalog; none where nothing was.
    pub fn of(entry: &RepresentationEntry, quality: &Quality) -> Option<Self> {
        let cost = quality.cost?;
        let values =
            |key: &str| quality.materials.iter().filter_map(|own| own.figures.get(key).copied()).collect::<Vec<_>>();
        let band = |key: &str| Some((key.to_owned(), Band::of(&values(key))?));
        let encode = Spread::new(values("encode_s").into_iter().map(|v| ("", v)), false)?;
        Some(Self {
            name: if entry.name == "znbrdf" { format!("znbrdf_{}", quality.dim) } else { entry.name.to_owned() },
            variant: entry.variant.name().to_owned(),
            family: entry.family,
            ns: cost.ns,
            ratio_to_reference_loop: cost.ratio_to_reference_loop,
            bytes: quality.bytes,
            shared_bytes: quality.shared_bytes,
            encode_s: encode.median,
            error: METRICS.iter().filter_map(|key| band(key)).collect(),
        })
    }

    /// Whether it could have been measured: printable words, finite numbers, none below 0, times above.
    pub fn is_sound(&self) -> bool {
        let is_word = |text: &str| (1..=64).contains(&text.len()) && !text.chars().any(char::is_control);
        let is_time = |value: f64| value.is_finite() && value > 0.0;
        let is_error =
            |band: &Band| [band.mean, band.p10, band.p90, band.max].iter().all(|v| v.is_finite() && *v >= 0.0);
        is_word(&self.name)
            && is_word(&self.variant)
            && is_time(self.ns)
            && is_time(self.ratio_to_reference_loop)
            && is_time(self.encode_s)
            && self.error.values().all(is_error)
    }

    /// Its name, with how its codes are made where that is not the plain way.
    pub fn title(&self) -> String {
        match self.variant.as_str() {
            "refined" | "feed_forward" => format!("{} {}", self.name, self.variant.replace('_', "-")),
            _ => self.name.clone(),
        }
    }
}

/// Errors that a chart can show: all of which less is better.
pub const METRICS: [&str; 6] =
    ["studio_flip", "studio_delta_e_itp", "point_flip", "point_delta_e_itp", "log_error", "relative_log"];

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
