//! Lines of a sweep, one panel per figure.

use std::path::Path;

use anyhow::Result;

use crate::output;
use crate::report::svg::scatter::{Kind, Panel, Scatter, Shape, Spot};

/// A point of a line.
pub struct Point {
    /// Place, above 0.
    pub x: f64,
    /// Value, above 0.
    pub y: f64,
    /// What stands beside it.
    pub label: String,
    /// What a pointer over it is told.
    pub about: String,
}

/// One figure of a sweep.
pub struct Lines {
    /// What is shown.
    pub title: String,
    /// With its unit.
    pub y_label: String,
    /// Whether values go up and down between the points, and do not stay until the next.
    pub is_straight: bool,
    /// Each with its name.
    pub lines: Vec<(String, Vec<Point>)>,
}

/// The chart of a sweep.
pub struct Curve {
    /// What was found.
    pub title: String,
    /// How it was measured.
    pub subtitle: String,
    /// What changes, with its unit.
    pub x_label: String,
    /// One or more.
    pub panels: Vec<Lines>,
}

impl Curve {
    /// Writes it in the form of the path's extension.
    pub fn write(self, path: &Path) -> Result<()> {
        let names: Vec<String> = self.panels.iter().flat_map(|panel| &panel.lines).map(|line| line.0.clone()).collect();
        let mut kinds: Vec<String> = Vec::new();
        for name in names {
            if !kinds.contains(&name) {
                kinds.push(name);
            }
        }
        let kind = |(place, name): (usize, &String)| Kind {
            name: name.clone(),
            // The line is that of the first kind.
            colour: [3, 1, 2][place % 3],
            shape: [Shape::Circle, Shape::Square, Shape::Up][place % 3],
        };
        let panel = |Lines { title, y_label, is_straight, lines }: Lines| {
            let (mut spots, mut front) = (Vec::new(), Vec::new());
            for (name, points) in lines {
                let kind = kinds.iter().position(|known| *known == name).unwrap_or_default();
                for point in points {
                    if kind == 0 {
                        front.push(spots.len());
                    }
                    let Point { x, y, label, about } = point;
                    spots.push(Spot { x, y, band: [f64::NAN; 2], size: 5.0 - 1.5 * kind as f64, kind, label, about });
                }
            }
            Panel { title, x_label: self.x_label.clone(), y_label, spots, front, is_straight }
        };
        let scatter = Scatter {
            title: self.title,
            subtitle: self.subtitle,
            kinds: kinds.iter().enumerate().map(kind).collect(),
            panels: self.panels.into_iter().map(panel).collect(),
            is_dark: false,
        };
        output::write_chart(path, &scatter.svg())
    }
}
