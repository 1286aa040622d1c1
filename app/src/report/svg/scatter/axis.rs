//! Logarithmic axes.

use crate::report::svg::power;

/// A logarithmic axis.
pub(super) struct Axis {
    low: f64,
    high: f64,
    start: f64,
    length: f64,
}

impl Axis {
    /// Over these values with a little room; none where there are none.
    pub fn of(values: impl Iterator<Item = f64>, start: f64, length: f64) -> Option<Self> {
        let values = values.filter(|v| v.is_finite() && *v > 0.0).map(f64::log10);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let room = (0.05 * (high - low)).max(0.1);
        (low <= high).then_some(Self { low: low - room, high: high + room, start, length })
    }

    pub fn place(&self, value: f64) -> f64 {
        self.start + (value.log10() - self.low) / (self.high - self.low) * self.length
    }

    /// Powers of ten; twice and five times them as well where there are few, and all between where there are fewer.
    pub fn ticks(&self) -> Vec<(f64, String)> {
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let steps: &[u8] = match self.high - self.low {
            ..0.8 => &[1, 2, 3, 4, 5, 6, 7, 8, 9],
            ..3.2 => &[1, 2, 5],
            _ => &[1],
        };
        let all = decades
            .flat_map(|decade| steps.iter().map(move |&step| (f64::from(step) * 10f64.powi(decade), decade, step)));
        let inside = all.filter(|(value, ..)| (self.low..=self.high).contains(&value.log10()));
        inside.map(|(value, decade, step)| (value, tick(decade, step))).collect()
    }
}

fn tick(decade: i32, step: u8) -> String {
    match (step, decade) {
        (1, _) => power(decade),
        (_, 0..=4) => format!("{}", u64::from(step) * 10u64.pow(decade.unsigned_abs())),
        (_, -3..0) => format!("{:.*}", decade.unsigned_abs() as usize, f64::from(step) * 10f64.powi(decade)),
        _ => format!("{step}e{decade}"),
    }
}
