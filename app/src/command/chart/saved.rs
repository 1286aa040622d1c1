//! The report behind a chart: printed by `--json`, drawn again by `--from`.

use std::path::Path;

use anyhow::Result;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::measure::front::{TIE, front};
use crate::measure::point::Point;

/// Largest report that is read \[bytes\].
const MAX_BYTES: u64 = 16 << 20;

/// Most points that are drawn.
const MOST_POINTS: usize = 1000;

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
        if saved.schema != 1 {
            return Err(invalid(&format_args!("schema {}", saved.schema)).into());
        }
        if saved.points.is_empty() || saved.points.len() > MOST_POINTS {
            return Err(invalid(&format_args!("{} points, of 1 to {MOST_POINTS}", saved.points.len())).into());
        }
        match saved.points.iter().find(|point| !point.is_sound()) {
            Some(point) => Err(invalid(&format_args!("a point {:?} that nobody measures", point.name)).into()),
            None => Ok(saved),
        }
    }

    /// Refuses a metric that was not measured.
    pub fn check_metric(&self, metric: &str) -> Result<()> {
        if self.points.iter().any(|point| point.error.contains_key(metric)) {
            return Ok(());
        }
        Err(Failure::InvalidFile(format!("expected points with {metric} in the report, found none: measure again"))
            .into())
    }

    /// Places of the models that are worth their time by this error.
    pub fn front(&self, metric: &str) -> Vec<usize> {
        self.front_of(metric, TIE, |point| point.ns)
    }

    /// The same for another cost; costs within a factor `tie` are the same.
    pub fn front_of(&self, metric: &str, tie: f64, cost: impl Fn(&Point) -> f64) -> Vec<usize> {
        let error = |point: &Point| point.error.get(metric).map_or(f64::NAN, |band| band.mean);
        front(&self.points.iter().map(|point| (cost(point), error(point))).collect::<Vec<_>>(), tie)
    }

    /// The report, with the front by name.
    pub fn json(&self, metric: &str) -> Value {
        let mut value = json!(self);
        value["metric"] = metric.into();
        value["front"] = self.front(metric).into_iter().map(|i| self.points[i].title()).collect();
        value
    }
}
