//! Charts as SVG, readable at page width in light and in dark: points over a logarithmic axis here, lines and maps beside.

pub mod grid;
mod lines;
pub mod map;
pub mod scatter;

use std::fmt::{self, Write};

pub use lines::{LineChart, Scale};

/// Size of a chart in its own units; text is 13 units high.
const WIDTH: f64 = 920.0;
const HEIGHT: f64 = 520.0;
/// Room for the axes, and above them for title and legend.
const LEFT: f64 = 74.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 96.0;
const BOTTOM: f64 = 56.0;

/// How a point looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A filled circle.
    Dot,
    /// A circle's outline.
    Ring,
    /// A cross.
    Cross,
    /// A filled square.
    Square,
}

/// Points of one kind.
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// One of the eight colours of the style sheet.
    pub colour: usize,
    /// Its shape.
    pub mark: Mark,
    /// Place, value and what a pointer over the point is told.
    pub points: Vec<(f64, f64, String)>,
}

/// A chart over places 0, 1, 2, ... with a logarithmic axis of values.
pub struct LogChart {
    /// What was found.
    pub title: String,
    /// How it was measured.
    pub subtitle: String,
    /// What stands side by side.
    pub x_label: String,
    /// What is measured, with its unit.
    pub y_label: String,
    /// Places that are named on the axis; none where they are only ranks.
    pub x_ticks: Vec<(f64, String)>,
    /// The points.
    pub series: Vec<Series>,
}

impl LogChart {
    /// The whole file.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let values = || self.series.iter().flat_map(|series| &series.points).map(|point| point.1).filter(|v| *v > 0.0);
        let (lowest, highest) = values().fold((f64::INFINITY, 0.0f64), |(low, high), v| (low.min(v), high.max(v)));
        if !(lowest.is_finite() && highest.is_finite() && highest > 0.0) {
            return empty(out);
        }
        let (low, high) = (lowest.log10().floor(), highest.log10().ceil().max(lowest.log10().floor() + 1.0));
        let places = self.series.iter().flat_map(|series| &series.points).map(|point| point.0).fold(1.0, f64::max);
        let x = |place: f64| LEFT + 8.0 + place / places * (WIDTH - LEFT - RIGHT - 16.0);
        let y = |value: f64| TOP + (high - value.log10()) / (high - low) * (HEIGHT - TOP - BOTTOM);
        head(out, &self.title, &self.subtitle, [WIDTH, HEIGHT], STYLE)?;
        for decade in low as i32..=high as i32 {
            height(out, y(10f64.powi(decade)), &power(decade))?;
        }
        for (place, tick) in &self.x_ticks {
            let (at, low) = (x(*place), HEIGHT - BOTTOM);
            writeln!(
                out,
                "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{TOP}\" y2=\"{low}\"/>\n\
                 <text class=\"label\" x=\"{at:.1}\" y=\"{:.1}\">{}</text>",
                low + 16.0,
                escaped(tick)
            )?;
        }
        labels(out, &self.x_label, &self.y_label)?;
        let mut legend = LEFT + 8.0;
        for series in &self.series {
            mark(out, series, legend, 72.0, "")?;
            writeln!(out, "<text x=\"{:.1}\" y=\"76.5\">{}</text>", legend + 10.0, escaped(&series.name))?;
            legend += 34.0 + 7.2 * series.name.chars().count() as f64;
            for (place, value, about) in series.points.iter().filter(|point| point.1 > 0.0) {
                mark(out, series, x(*place), y(*value), about)?;
            }
        }
        writeln!(out, "</svg>")
    }
}

/// A picture of nothing.
fn empty(out: &mut String) -> fmt::Result {
    write!(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>")
}

/// Opens the file: style sheet, page, title, subtitle.
fn head(out: &mut String, title: &str, subtitle: &str, [width, height]: [f64; 2], style: &str) -> fmt::Result {
    let (title, subtitle) = (escaped(title), escaped(subtitle));
    writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" role=\"img\">\n<title>{title}</title>\n<style>{style}</style>\n\
         <rect class=\"page\" width=\"{width}\" height=\"{height}\"/>\n\
         <text class=\"title\" x=\"16\" y=\"28\">{title}</text>\n\
         <text class=\"quiet\" x=\"16\" y=\"48\">{subtitle}</text>"
    )
}

/// A line across, with what stands at its left.
fn height(out: &mut String, at: f64, tick: &str) -> fmt::Result {
    let (right, left) = (WIDTH - RIGHT, LEFT - 8.0);
    writeln!(out, "<line class=\"grid\" x1=\"{LEFT}\" x2=\"{right}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>")?;
    writeln!(out, "<text class=\"tick\" x=\"{left}\" y=\"{:.1}\">{tick}</text>", at + 4.5)
}

/// What the axes say.
fn labels(out: &mut String, x_label: &str, y_label: &str) -> fmt::Result {
    let middle = TOP + 0.5 * (HEIGHT - TOP - BOTTOM);
    writeln!(
        out,
        "<text class=\"label\" transform=\"translate(20 {middle:.1}) rotate(-90)\">{}</text>\n\
         <text class=\"label\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
        escaped(y_label),
        0.5 * (LEFT + WIDTH - RIGHT),
        HEIGHT - 18.0,
        escaped(x_label)
    )
}

/// A power of ten at an axis.
fn power(decade: i32) -> String {
    if (-3..=4).contains(&decade) { plain(decade) } else { format!("1e{decade}") }
}

/// A power of ten in digits.
fn plain(decade: i32) -> String {
    if decade >= 0 {
        format!("{}", 10i64.pow(decade.unsigned_abs()))
    } else {
        format!("{:.*}", decade.unsigned_abs() as usize, 10f64.powi(decade))
    }
}

fn mark(out: &mut String, series: &Series, x: f64, y: f64, about: &str) -> fmt::Result {
    let (colour, about) = (series.colour, escaped(about));
    let tip = if about.is_empty() { String::new() } else { format!("<title>{about}</title>") };
    match series.mark {
        Mark::Dot => writeln!(out, "<circle class=\"f{colour}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.4\">{tip}</circle>"),
        Mark::Ring => writeln!(out, "<circle class=\"s{colour}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.1\">{tip}</circle>"),
        Mark::Cross => writeln!(
            out,
            "<path class=\"s{colour}\" d=\"M{:.1} {:.1}l5.6 5.6m0 -5.6l-5.6 5.6\">{tip}</path>",
            x - 2.8,
            y - 2.8
        ),
        Mark::Square => writeln!(
            out,
            "<rect class=\"f{colour}\" x=\"{:.1}\" y=\"{:.1}\" width=\"6\" height=\"6\">{tip}</rect>",
            x - 3.0,
            y - 3.0
        ),
    }
}

pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Colours that keep apart for most kinds of colour vision (M. Okabe, K. Ito, *Color Universal Design*, 2002), lighter
/// on dark pages.
const STYLE: &str = "\
text{font:13px system-ui,sans-serif;fill:#222}.title{font-size:17px;font-weight:600}.quiet{fill:#666}\
.tick{text-anchor:end;fill:#555}.label{text-anchor:middle;fill:#333}.page{fill:#fff}.grid{stroke:#ddd}\
.f0{fill:#999}.f1{fill:#0072b2}.f2{fill:#009e73}.f3{fill:#d55e00}.f4{fill:#cc79a7}.f5{fill:#56b4e9}\
.f6{fill:#b58900}.f7{fill:#7a4fd0}\
.s0,.s1,.s2,.s3,.s4,.s5,.s6,.s7{fill:none;stroke-width:1.5}\
.s0{stroke:#999}.s1{stroke:#0072b2}.s2{stroke:#009e73}.s3{stroke:#d55e00}.s4{stroke:#cc79a7}.s5{stroke:#56b4e9}\
.s6{stroke:#b58900}.s7{stroke:#7a4fd0}\
@media(prefers-color-scheme:dark){text{fill:#e6e6e6}.quiet,.tick{fill:#aaa}.label{fill:#ccc}.page{fill:#16181c}\
.grid{stroke:#34373d}.f1{fill:#4aa8e8}.s1{stroke:#4aa8e8}.f2{fill:#2fc79b}.s2{stroke:#2fc79b}.f3{fill:#ff8b3d}\
.s3{stroke:#ff8b3d}.f6{fill:#d9ad2b}.s6{stroke:#d9ad2b}.f7{fill:#a98bf0}.s7{stroke:#a98bf0}}";

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<(f64, f64, String)>) -> LogChart {
        let word = || "a < b & c".to_owned();
        let series = vec![Series { name: word(), colour: 1, mark: Mark::Cross, points }];
        let x_ticks = vec![(1.0, word())];
        LogChart { title: word(), subtitle: word(), x_label: word(), y_label: word(), x_ticks, series }
    }

    #[test]
    fn larger_values_stand_higher_and_text_is_escaped() {
        let svg = chart(vec![(0.0, 0.01, String::new()), (1.0, 100.0, "tip".to_owned())]).svg();
        assert!(svg.contains("a &lt; b &amp; c") && !svg.contains("a < b"));
        let height = |line: &str| -> Option<f64> { line.split("d=\"M").nth(1)?.split([' ', 'l']).nth(1)?.parse().ok() };
        let heights: Vec<f64> = svg.lines().filter_map(height).collect();
        assert_eq!(heights.len(), 3, "legend and two points");
        assert!(heights[2] < heights[1], "{heights:?}");
    }

    #[test]
    fn a_chart_of_nothing_is_still_a_picture() {
        assert!(chart(Vec::new()).svg().starts_with("<svg"));
        assert!(chart(vec![(0.0, f64::NAN, String::new())]).svg().starts_with("<svg"));
    }
}
