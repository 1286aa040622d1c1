//! Lines over a numbered axis: how figures change with one number.

use std::fmt::{self, Write};

use super::{
    BOTTOM, HEIGHT, LEFT, RIGHT, STYLE, Series, TOP, WIDTH, empty, escaped, head, height, labels, mark, power,
};

/// Numbers written below the axis, at most.
const TICKS: f64 = 10.0;

/// How values stand above each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// By their logarithms, down to this power of ten; what is below is left out.
    Powers {
        /// The lowest power.
        lowest: i32,
    },
    /// Shares, 0 to 1, in percent.
    Percent,
}

/// A chart of lines; places are numbers from 0.
pub struct LineChart {
    /// What was found.
    pub title: String,
    /// How it was measured.
    pub subtitle: String,
    /// What is counted, with its unit.
    pub x_label: String,
    /// What is measured, with its unit.
    pub y_label: String,
    /// Of the measured values.
    pub scale: Scale,
    /// The lines, through their points in the order given.
    pub series: Vec<Series>,
}

impl LineChart {
    /// The whole file.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let points = || self.series.iter().flat_map(|series| &series.points).filter(|point| self.shows(point.1));
        let widest = points().map(|point| point.0).fold(0.0, f64::max);
        if widest <= 0.0 {
            return empty(out);
        }
        let highest = points().map(|point| point.1).fold(0.0, f64::max);
        let ticks = self.scale.ticks(highest);
        let (low, high) = (ticks[0].0, ticks[ticks.len() - 1].0);
        let x = |place: f64| LEFT + 8.0 + place / widest * (WIDTH - LEFT - RIGHT - 16.0);
        let y = |position: f64| TOP + (high - position) / (high - low) * (HEIGHT - TOP - BOTTOM);
        head(out, &self.title, &self.subtitle, [WIDTH, HEIGHT], STYLE)?;
        for (position, tick) in &ticks {
            height(out, y(*position), tick)?;
        }
        // Whole steps: the axis counts.
        let step = round_step(widest / TICKS).max(1.0);
        for place in (0..).map(|i| f64::from(i) * step).take_while(|place| *place <= widest) {
            let (at, below) = (x(place), HEIGHT - BOTTOM + 17.0);
            writeln!(out, "<text class=\"label\" x=\"{at:.1}\" y=\"{below:.1}\">{place}</text>")?;
        }
        labels(out, &self.x_label, &self.y_label)?;
        let mut legend = LEFT + 8.0;
        for series in &self.series {
            mark(out, series, legend, 72.0, "")?;
            writeln!(out, "<text x=\"{:.1}\" y=\"76.5\">{}</text>", legend + 10.0, escaped(&series.name))?;
            legend += 34.0 + 7.2 * series.name.chars().count() as f64;
            let shown = || series.points.iter().filter(|point| self.shows(point.1));
            let line: Vec<String> =
                shown().map(|point| format!("{:.1},{:.1}", x(point.0), y(self.scale.position(point.1)))).collect();
            writeln!(out, "<polyline class=\"s{}\" points=\"{}\"/>", series.colour, line.join(" "))?;
            for (place, value, about) in shown() {
                mark(out, series, x(*place), y(self.scale.position(*value)), about)?;
            }
        }
        writeln!(out, "</svg>")
    }

    fn shows(&self, value: f64) -> bool {
        match self.scale {
            Scale::Powers { lowest } => value.is_finite() && value >= 10f64.powi(lowest),
            Scale::Percent => (0.0..=1.0).contains(&value),
        }
    }
}

impl Scale {
    fn position(self, value: f64) -> f64 {
        match self {
            Self::Powers { .. } => value.log10(),
            Self::Percent => value,
        }
    }

    /// Positions and names of the lines across, from the lowest, at least two.
    fn ticks(self, highest: f64) -> Vec<(f64, String)> {
        match self {
            Self::Powers { lowest } => {
                let top = (highest.log10().ceil() as i32).max(lowest + 1);
                (lowest..=top).map(|decade| (f64::from(decade), power(decade))).collect()
            }
            Self::Percent => (0..=5).map(|fifth| (f64::from(fifth) / 5.0, format!("{} %", 20 * fifth))).collect(),
        }
    }
}

/// 1, 2 or 5 times a power of ten, not below `step`.
fn round_step(step: f64) -> f64 {
    let decade = 10f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|factor| factor * decade).find(|round| *round >= step).unwrap_or(step)
}

#[cfg(test)]
mod tests {
    use super::super::Mark;
    use super::*;

    fn chart(scale: Scale, values: &[f64]) -> String {
        let points = values.iter().enumerate().map(|(i, &v)| (i as f64, v, String::new())).collect();
        let series = vec![Series { name: "a < b".to_owned(), colour: 1, mark: Mark::Dot, points }];
        let word = || "w".to_owned();
        LineChart { title: word(), subtitle: word(), x_label: word(), y_label: word(), scale, series }.svg()
    }

    /// Corners of the only line.
    fn corners(svg: &str) -> Vec<Vec<f64>> {
        let line = svg.lines().find(|line| line.starts_with("<polyline")).unwrap();
        let points = line.split("points=\"").nth(1).unwrap().trim_end_matches("\"/>");
        let corner = |corner: &str| corner.split(',').map(|v| v.parse().unwrap()).collect();
        points.split_whitespace().map(corner).collect()
    }

    #[test]
    fn half_of_all_stands_in_the_middle_and_a_tenth_is_a_decade_lower() {
        let shares = corners(&chart(Scale::Percent, &[0.0, 1.0, 0.5]));
        assert!((shares[2][1] - 0.5 * (shares[0][1] + shares[1][1])).abs() < 0.11);
        let powers = corners(&chart(Scale::Powers { lowest: -4 }, &[1.0, 0.1, 0.01, 1e-9]));
        assert_eq!(powers.len(), 3, "what is below the lowest power is left out");
        assert!(((powers[1][1] - powers[0][1]) - (powers[2][1] - powers[1][1])).abs() < 0.11);
    }

    #[test]
    fn places_are_numbered_in_round_steps_and_nothing_is_still_a_picture() {
        let many = chart(Scale::Percent, &[0.5; 80]);
        assert!(many.contains(">70</text>") && !many.contains(">75</text>") && many.contains("a &lt; b"));
        assert!(chart(Scale::Percent, &[f64::NAN]).starts_with("<svg"));
        assert!(chart(Scale::Powers { lowest: -3 }, &[]).starts_with("<svg"));
    }
}
