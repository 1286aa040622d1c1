//! The report behind a chart: printed by `--json`, drawn again by `--from`.

use std::fmt::Display;
use std::path::Path;

use anyhow::Result;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::stability::Stability;
use crate::failure::Failure;
use crate::measure::front::{TIE, front, front_of_run};
use crate::measure::point::Point;

/// Largest report that is read \[bytes\].
const MAX_BYTES: u64 = 16 << 20;

/// Most runs.
pub const MOST_RUNS: usize = 25;

/// Most points that are drawn.
const MOST_POINTS: usize = 1000;

/// Everything a chart is drawn from.
#[derive(Deserialize, Serialize)]
pub struct Saved {
    /// Of the report: 1.
    pub schema: u32,
    /// Where the reference materials come from.
    pub reference: String,
    /// How many there were.
    pub materials: usize,
    /// Whether it was a quick look.
    pub quick: bool,
    /// How many runs the times are medians of.
    #[serde(default = "one")]
    pub runs: usize,
    /// The models.
    pub points: Vec<Point>,
}

impl Saved {
    /// Reads a report.
    pub fn load(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let bytes = nbrdf_core::bounded::read(path, MAX_BYTES).map_err(|error| invalid(&name, &error))?;
        let bytes = bytes.ok_or_else(|| invalid(&name, &format_args!("more than {MAX_BYTES} bytes")))?;
        Self::parse(&name, &bytes)
    }

    /// The report in bytes that came from `path`.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self> {
        let invalid = |found: &dyn Display| invalid(path, found);
        let saved: Self = serde_json::from_slice(bytes).map_err(|error| invalid(&error))?;
        if saved.schema != 1 {
            return Err(invalid(&format_args!("schema {}", saved.schema)).into());
        }
        if saved.points.is_empty() || saved.points.len() > MOST_POINTS {
            return Err(invalid(&format_args!("{} points, of 1 to {MOST_POINTS}", saved.points.len())).into());
        }
        if !(1..=MOST_RUNS).contains(&saved.runs) {
            return Err(invalid(&format_args!("{} runs, of 1 to {MOST_RUNS}", saved.runs)).into());
        }
        let is_of_all_runs = |own: usize| own == saved.runs || (own == 0 && saved.runs == 1);
        let is_sound = |point: &Point| point.is_sound() && is_of_all_runs(point.by_run.len());
        match saved.points.iter().find(|point| !is_sound(point)) {
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
        self.front_of(metric, TIE, |point| point.times.ns)
    }

    /// The same for another cost; costs within a factor `tie` are the same.
    pub fn front_of(&self, metric: &str, tie: f64, cost: impl Fn(&Point) -> f64) -> Vec<usize> {
        front(&self.models(metric, cost), tie)
    }

    /// The front of evaluation in one run, near ties decided by the medians.
    pub fn front_of_run(&self, metric: &str, run: usize) -> Vec<usize> {
        let ns: Vec<f64> = self.points.iter().map(|point| point.run(run).ns).collect();
        front_of_run(&ns, &self.models(metric, |point| point.times.ns), TIE)
    }

    /// Titles of the models without any error: what they decode to is the reference itself, for which a logarithmic axis
    /// has no place.
    pub fn references(&self, metric: &str) -> Vec<String> {
        let is_exact = |point: &&Point| point.error.get(metric).is_some_and(|band| band.max == 0.0);
        self.points.iter().filter(is_exact).map(Point::title).collect()
    }

    /// Costs and errors.
    fn models(&self, metric: &str, cost: impl Fn(&Point) -> f64) -> Vec<(f64, f64)> {
        let error = |point: &Point| point.error.get(metric).map_or(f64::NAN, |band| band.mean);
        self.points.iter().map(|point| (cost(point), error(point))).collect()
    }

    /// The report, with the front by name, and that of every run.
    pub fn json(&self, metric: &str) -> Value {
        let mut value = json!(self);
        let stability = Stability::of(self, metric);
        value["metric"] = metric.into();
        value["front"] = self.front(metric).into_iter().map(|i| self.points[i].title()).collect();
        value["fronts"] = json!(stability.fronts);
        value["stable"] = stability.is_stable().into();
        value
    }
}

fn invalid(path: &str, found: &dyn Display) -> Failure {
    Failure::InvalidFile(format!("{path}: expected a report of `nbrdf chart --json`, found {found}: make it again"))
}

const fn one() -> usize {
    1
}
