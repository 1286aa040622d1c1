//! The report behind a chart: printed by `--json`, drawn again by `--from`.

use anyhow::Result;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::stability::Stability;
use crate::failure::Failure;
use crate::measure::front::{TIE, front, front_of_run};
use crate::measure::point::Point;
use crate::report::saved::SavedReport;

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

impl SavedReport for Saved {
    const COMMAND: &'static str = "chart";
    const MAX_BYTES: u64 = 16 << 20;

    fn schema(&self) -> u32 {
        self.schema
    }

    fn check(&self) -> Result<(), String> {
        if self.points.is_empty() || self.points.len() > MOST_POINTS {
            return Err(format!("{} points, of 1 to {MOST_POINTS}", self.points.len()));
        }
        if !(1..=MOST_RUNS).contains(&self.runs) {
            return Err(format!("{} runs, of 1 to {MOST_RUNS}", self.runs));
        }
        let is_of_all_runs = |own: usize| own == self.runs || (own == 0 && self.runs == 1);
        let is_sound = |point: &Point| point.is_sound() && is_of_all_runs(point.by_run.len());
        match self.points.iter().find(|point| !is_sound(point)) {
            Some(point) => Err(format!("a point {:?} that nobody measures", point.name)),
            None => Ok(()),
        }
    }
}

impl Saved {
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

const fn one() -> usize {
    1
}
