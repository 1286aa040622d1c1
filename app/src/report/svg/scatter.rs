//! Points over two logarithmic axes, several panels in one picture: what something costs against how good it is.

mod axis;
mod labels;
mod shape;

use std::fmt::{self, Write};

use super::{STYLE, escaped, head};
use axis::Axis;
use labels::{Frame, labels};
use shape::shape;

pub use shape::Shape;

/// Size of the picture; text is 13 units high.
const WIDTH: f64 = 920.0;
/// Above the panels: title, subtitle, legend.
const TOP: f64 = 92.0;
/// Heights of the first panel and of those below it, and the space between.
const FIRST: f64 = 430.0;
const OTHERS: f64 = 330.0;
const GAP: f64 = 26.0;
/// Room around a panel's plot: left for the axis, below for ticks and label, above for its title.
const LEFT: f64 = 66.0;
const RIGHT: f64 = 14.0;
const ABOVE: f64 = 26.0;
const BELOW: f64 = 46.0;

/// A kind of points.
pub struct Kind {
    /// Name in the legend.
    pub name: String,
    /// One of the style sheet's colours.
    pub colour: usize,
    /// Its shape.
    pub shape: Shape,
}

/// A point.
pub struct Spot {
    /// Place, above 0.
    pub x: f64,
    /// Value, above 0.
    pub y: f64,
    /// From where to where most values lie.
    pub band: [f64; 2],
    /// Radius.
    pub size: f64,
    /// Place of its kind in the legend.
    pub kind: usize,
    /// What stands beside it, where there is room.
    pub label: String,
    /// What a pointer over it is told.
    pub about: String,
}

impl Spot {
    /// Whether logarithmic axes have a place for it.
    fn is_shown(&self) -> bool {
        [self.x, self.y].iter().all(|v| *v > 0.0 && v.is_finite())
    }
}

/// One pair of axes.
pub struct Panel {
    /// What is set against what.
    pub title: String,
    /// With its unit.
    pub x_label: String,
    /// With its unit.
    pub y_label: String,
    /// The points.
    pub spots: Vec<Spot>,
    /// Places of those on the front, by rising x.
    pub front: Vec<usize>,
    /// Whether the front is a line from point to point, and not of steps.
    pub is_straight: bool,
}

/// The picture: the first panel above, the others side by side below.
pub struct Scatter {
    /// What was found.
    pub title: String,
    /// How it was measured.
    pub subtitle: String,
    /// Kinds of points.
    pub kinds: Vec<Kind>,
    /// Two to four panels.
    pub panels: Vec<Panel>,
    /// Dark whatever the reader prefers; else as he prefers.
    pub is_dark: bool,
}

impl Scatter {
    /// The whole file.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let below = self.panels.len().saturating_sub(1);
        let height = TOP + FIRST + if below > 0 { GAP + OTHERS } else { 0.0 } + 10.0;
        let style = if self.is_dark { dark(STYLE) } else { STYLE.to_owned() };
        head(out, &self.title, &self.subtitle, [WIDTH, height], &(style + MORE))?;
        self.legend(out)?;
        for (place, panel) in self.panels.iter().enumerate() {
            let frame = match place {
                0 => Frame { x: 0.0, y: TOP, width: WIDTH, height: FIRST },
                _ => {
                    let width = WIDTH / below as f64;
                    Frame { x: width * (place - 1) as f64, y: TOP + FIRST + GAP, width, height: OTHERS }
                }
            };
            self.panel(out, panel, frame)?;
        }
        writeln!(out, "</svg>")
    }

    fn legend(&self, out: &mut String) -> fmt::Result {
        let mut x = 22.0;
        for kind in &self.kinds {
            shape(out, kind, [x, 70.0], 5.0, "")?;
            writeln!(out, "<text x=\"{:.1}\" y=\"74.5\">{}</text>", x + 10.0, escaped(&kind.name))?;
            x += 34.0 + 7.2 * kind.name.chars().count() as f64;
        }
        Ok(())
    }

    fn panel(&self, out: &mut String, panel: &Panel, frame: Frame) -> fmt::Result {
        let plot = Frame {
            x: frame.x + LEFT,
            y: frame.y + ABOVE,
            width: frame.width - LEFT - RIGHT,
            height: frame.height - ABOVE - BELOW,
        };
        writeln!(
            out,
            "<text class=\"head\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            plot.x,
            frame.y + 14.0,
            escaped(&panel.title)
        )?;
        let shown: Vec<&Spot> = panel.spots.iter().filter(|spot| spot.is_shown()).collect();
        let (Some(across), Some(along)) = (
            Axis::of(shown.iter().map(|spot| spot.x), plot.x + 10.0, plot.width - 20.0),
            Axis::of(
                shown.iter().flat_map(|spot| [spot.y, spot.band[0], spot.band[1]]),
                plot.y + plot.height - 8.0,
                16.0 - plot.height,
            ),
        ) else {
            return Ok(());
        };
        for (value, name) in along.ticks() {
            let at = along.place(value);
            let right = plot.x + plot.width;
            writeln!(
                out,
                "<line class=\"grid\" x1=\"{:.1}\" x2=\"{right:.1}\" y1=\"{at:.1}\" y2=\"{at:.1}\"/>",
                plot.x
            )?;
            writeln!(out, "<text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\">{name}</text>", plot.x - 6.0, at + 4.5)?;
        }
        let bottom = plot.y + plot.height;
        for (value, name) in across.ticks() {
            let at = across.place(value);
            writeln!(
                out,
                "<line class=\"grid\" x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{:.1}\" y2=\"{bottom:.1}\"/>",
                plot.y
            )?;
            writeln!(out, "<text class=\"label\" x=\"{at:.1}\" y=\"{:.1}\">{name}</text>", bottom + 16.0)?;
        }
        let middle = plot.y + 0.5 * plot.height;
        writeln!(
            out,
            "<text class=\"label\" transform=\"translate({:.1} {middle:.1}) rotate(-90)\">{}</text>\n\
             <text class=\"label\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            frame.x + 18.0,
            escaped(&panel.y_label),
            plot.x + 0.5 * plot.width,
            bottom + 36.0,
            escaped(&panel.x_label)
        )?;
        let place = |spot: &Spot| [across.place(spot.x), along.place(spot.y)];
        let front = panel.front.iter().filter_map(|&i| panel.spots.get(i)).filter(|spot| spot.is_shown()).map(place);
        path(out, front, panel.is_straight)?;
        for spot in &shown {
            let [x, _] = place(spot);
            // A band down to nothing ends at the axis.
            let [low, high] = spot.band.map(|v| along.place(if v > 0.0 { v } else { spot.y }));
            let colour = self.kinds[spot.kind].colour;
            writeln!(
                out,
                "<line class=\"s{colour} band\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{low:.1}\" y2=\"{high:.1}\"/>"
            )?;
        }
        // Large ones first: small ones stay visible.
        let mut order = shown.clone();
        order.sort_by(|a, b| b.size.total_cmp(&a.size));
        for spot in order {
            shape(out, &self.kinds[spot.kind], place(spot), spot.size, &spot.about)?;
        }
        labels(out, panel, &shown, &place, plot)
    }
}

/// The front: a line, or steps, since whoever pays less has at least this error.
fn path(out: &mut String, corners: impl Iterator<Item = [f64; 2]>, is_straight: bool) -> fmt::Result {
    let mut path = String::new();
    for [x, y] in corners {
        match (path.is_empty(), is_straight) {
            (true, _) => write!(path, "M{x:.1} {y:.1}")?,
            (false, true) => write!(path, "L{x:.1} {y:.1}")?,
            (false, false) => write!(path, "H{x:.1}V{y:.1}")?,
        }
    }
    if path.is_empty() { Ok(()) } else { writeln!(out, "<path class=\"front\" d=\"{path}\"/>") }
}

/// The style sheet as on dark pages.
fn dark(style: &str) -> String {
    style.replace("@media(prefers-color-scheme:dark){", "").trim_end_matches('}').to_owned() + "}"
}

const MORE: &str = "\
.head{font-weight:600}.name{font-size:11.5px}.band{stroke-opacity:.35}.mark{stroke:#fff;stroke-width:.6;fill-opacity:.9}\
.front{fill:none;stroke:#d55e00;stroke-width:1.2;stroke-dasharray:5 3;stroke-opacity:.8}";

#[cfg(test)]
mod tests;
