//! The report behind a chart: printed by `--json`, drawn again by `--from`.

use std::path::Path;

use anyhow::Result;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::measure::front::front;
use crate::measure::point::Point;

/// Largest report that is read \[bytes\].
const MAX_BYTES: u64 = 16 << 20;

/// Everything a chart is drawn from.
#[derive(Deserialize, Serialize)]
pub struct Saved {
    schema: u32,
    /// Where the reference materials come from.
    pub reference: String,
    /// How many there were.
    pub materials: usize,
    /// Whether it was a quick look.
    pub quick: bool,
    /// The models.
    pub points: Vec<Point>,
}

impl Saved {
    /// Of what was measured.
    pub const fn new(reference: String, materials: usize, quick: bool, points: Vec<Point>) -> Self {
        Self { schema: 1, reference, materials, quick, points }
    }

    /// Reads a report.
    pub fn load(path: &Path) -> Result<Self> {
        let invalid = |found: &dyn std::fmt::Display| {
            let path = path.display();
            Failure::InvalidFile(format!(
                "{path}: expected a report of `nbrdf chart --json`, found {found}: make it again"
            ))
        };
        let bytes = nbrdf_core::bounded::read(path, MAX_BYTES).map_err(|error| invalid(&error))?;
        let bytes = bytes.ok_or_else(|| invalid(&format_args!("more than {MAX_BYTES} bytes")))?;
        let saved: Self = serde_json::from_slice(&bytes).map_err(|error| invalid(&error))?;
        match saved.schema {
            1 => Ok(saved),
            other => Err(invalid(&format_args!("schema {other}")).into()),
        }
    }

    /// Places of the models that are worth their time by this error.
    pub fn front(&self, metric: &str) -> Vec<usize> {
        self.front_of(metric, |point| point.ns)
    }

    /// The same for another cost.
    pub fn front_of(&self, metric: &str, cost: impl Fn(&Point) -> f64) -> Vec<usize> {
        let error = |point: &Point| point.error.get(metric).map_or(f64::NAN, |band| band.mean);
        front(&self.points.iter().map(|point| (cost(point), error(point))).collect::<Vec<_>>())
    }

    /// The report, with the front by name.
    pub fn json(&self, metric: &str) -> Value {
        let mut value = json!(self);
        value["metric"] = metric.into();
        value["front"] = self.front(metric).into_iter().map(|i| self.points[i].title()).collect();
        value
    }
}
