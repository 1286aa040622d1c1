//! Marks that differ in shape and colour.

use std::fmt::{self, Write};

use super::Kind;
use crate::report::svg::escaped;

/// How a kind of point looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A circle.
    Circle,
    /// A square.
    Square,
    /// A square on its corner.
    Diamond,
    /// A triangle on its side.
    Up,
    /// A triangle on its corner.
    Down,
    /// A fat cross.
    Plus,
    /// Six corners.
    Hexagon,
}

/// A mark of this radius, and what a pointer over it is told.
pub(super) fn shape(out: &mut String, kind: &Kind, [x, y]: [f64; 2], size: f64, about: &str) -> fmt::Result {
    let corners = |count: usize, turn: f64| -> String {
        let corner = |i: usize| {
            let angle = std::f64::consts::TAU * (i as f64 + turn) / count as f64;
            format!("{:.1},{:.1}", x + size * angle.sin(), y - size * angle.cos())
        };
        (0..count).map(corner).collect::<Vec<_>>().join(" ")
    };
    let class = format!("class=\"f{} mark\"", kind.colour);
    let tip = if about.is_empty() { String::new() } else { format!("<title>{}</title>", escaped(about)) };
    match kind.shape {
        Shape::Circle => writeln!(out, "<circle {class} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{size:.1}\">{tip}</circle>"),
        Shape::Plus => {
            let (arm, half) = (size, 0.36 * size);
            writeln!(
                out,
                "<path {class} d=\"M{:.1} {:.1}h{:.1}v{:.1}h{:.1}v{:.1}h{:.1}v{:.1}h{:.1}v{:.1}h{:.1}v{:.1}h{:.1}z\">{tip}</path>",
                x - half,
                y - arm,
                2.0 * half,
                arm - half,
                arm - half,
                2.0 * half,
                half - arm,
                arm - half,
                -2.0 * half,
                half - arm,
                half - arm,
                -2.0 * half,
                arm - half
            )
        }
        other => {
            let points = match other {
                Shape::Square => corners(4, 0.5),
                Shape::Diamond => corners(4, 0.0),
                Shape::Up => corners(3, 0.0),
                Shape::Down => corners(3, 0.5),
                _ => corners(6, 0.0),
            };
            writeln!(out, "<polygon {class} points=\"{points}\">{tip}</polygon>")
        }
    }
}
