//! Named places in a plane, each in its own colour, with as many names as fit.

use std::fmt::{self, Write};

use super::{STYLE, escaped, head};

const WIDTH: f64 = 1180.0;
const HEIGHT: f64 = 860.0;
/// Room around the places, and above them for the title.
const MARGIN: f64 = 40.0;
const TOP: f64 = 76.0;
/// Radius of a place, and how far from it its name may be.
const RADIUS: f64 = 6.0;
const FARTHEST: f64 = 34.0;
/// A letter's width and a name's height.
const LETTER: f64 = 5.6;
const LINE: f64 = 11.0;

/// A named place.
pub struct Place {
    /// Name beside it.
    pub name: String,
    /// Where, to the right and upwards, in any unit.
    pub at: [f64; 2],
    /// Its colour.
    pub colour: [u8; 3],
    /// A square instead of a circle.
    pub marked: bool,
}

/// Places drawn to one scale in both directions.
pub struct Map {
    /// What was found.
    pub title: String,
    /// How it was measured.
    pub subtitle: String,
    /// The places.
    pub places: Vec<Place>,
}

/// Left, top, right, bottom.
#[derive(Clone, Copy)]
struct Frame([f64; 4]);

impl Frame {
    /// The area common with another.
    fn overlap(self, other: Self) -> f64 {
        let [a, b] = [self.0, other.0];
        let side = |low: usize| (a[low + 2].min(b[low + 2]) - a[low].max(b[low])).max(0.0);
        side(0) * side(1)
    }

    fn is_inside(self) -> bool {
        let [left, top, right, bottom] = self.0;
        left >= 4.0 && top >= TOP - 12.0 && right <= WIDTH - 4.0 && bottom <= HEIGHT - 4.0
    }
}

impl Map {
    /// The whole file.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        head(out, &self.title, &self.subtitle, [WIDTH, HEIGHT], &(STYLE.to_owned() + OWN_STYLE))?;
        let at = self.on_page();
        let labels = self.labels(&at);
        for (frame, &[x, y]) in labels.iter().zip(&at) {
            let Some(Frame([left, top, right, bottom])) = *frame else { continue };
            let nearest = [x.clamp(left, right), y.clamp(top, bottom)];
            if (nearest[0] - x).hypot(nearest[1] - y) > RADIUS + 6.0 {
                let [to_x, to_y] = nearest;
                writeln!(out, "<line class=\"lead\" x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\"/>")?;
            }
        }
        for (place, at) in self.places.iter().zip(&at) {
            place.write(out, *at)?;
        }
        for (place, frame) in self.places.iter().zip(&labels) {
            let Some(Frame([left, _, _, bottom])) = frame else { continue };
            let (name, base) = (escaped(&place.name), bottom - 2.5);
            writeln!(out, "<text class=\"name\" x=\"{left:.1}\" y=\"{base:.1}\">{name}</text>")?;
        }
        writeln!(out, "</svg>")
    }

    /// Places on the page, in its units.
    fn on_page(&self) -> Vec<[f64; 2]> {
        let range = |axis: usize| {
            let values = self.places.iter().map(|place| place.at[axis]).filter(|v| v.is_finite());
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (x, y) = (range(0), range(1));
        let room = [WIDTH - 2.0 * MARGIN, HEIGHT - TOP - MARGIN];
        let scale = (room[0] / (x.1 - x.0).max(1e-30)).min(room[1] / (y.1 - y.0).max(1e-30));
        let middle = [0.5 * (x.0 + x.1), 0.5 * (y.0 + y.1)];
        let page = |place: &Place| {
            let across = MARGIN + 0.5 * room[0] + scale * (place.at[0] - middle[0]);
            [across, TOP + 0.5 * room[1] - scale * (place.at[1] - middle[1])]
        };
        self.places.iter().map(page).collect()
    }

    /// Where names go: each as near to its place as it can be without covering a place or another name; none where there
    /// is no room. Crowded places choose first.
    fn labels(&self, at: &[[f64; 2]]) -> Vec<Option<Frame>> {
        const CROWD: f64 = 60.0;
        let reach = RADIUS + 1.0;
        let dots: Vec<Frame> = at.iter().map(|[x, y]| Frame([x - reach, y - reach, x + reach, y + reach])).collect();
        let crowd = |i: usize| at.iter().filter(|b| (b[0] - at[i][0]).hypot(b[1] - at[i][1]) < CROWD).count();
        let mut order: Vec<usize> = (0..at.len()).collect();
        order.sort_by_key(|&i| std::cmp::Reverse(crowd(i)));
        let mut labels: Vec<Option<Frame>> = vec![None; at.len()];
        for i in order {
            let width = LETTER * self.places[i].name.chars().count() as f64;
            let is_free = |frame: &Frame| {
                let taken = dots.iter().chain(labels.iter().flatten());
                frame.is_inside() && taken.into_iter().all(|other| frame.overlap(*other) == 0.0)
            };
            labels[i] = around(at[i], width).find(is_free);
        }
        labels
    }
}

impl Place {
    fn write(&self, out: &mut String, [x, y]: [f64; 2]) -> fmt::Result {
        let [r, g, b] = self.colour;
        let (look, tip) = (format!("class=\"place\" fill=\"#{r:02x}{g:02x}{b:02x}\""), escaped(&self.name));
        if self.marked {
            let (left, top, side) = (x - RADIUS, y - RADIUS, 2.0 * RADIUS);
            let size = format!("width=\"{side}\" height=\"{side}\"");
            return writeln!(out, "<rect {look} x=\"{left:.1}\" y=\"{top:.1}\" {size}><title>{tip}</title></rect>");
        }
        writeln!(out, "<circle {look} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{RADIUS}\"><title>{tip}</title></circle>")
    }
}

/// Frames of a name around a place, the nearest and rightmost first.
fn around([x, y]: [f64; 2], width: f64) -> impl Iterator<Item = Frame> {
    let rings = (0..8).map(|ring| RADIUS + 3.0 + f64::from(ring) * (FARTHEST - RADIUS - 3.0) / 7.0);
    rings.flat_map(move |radius| {
        [0.0, 0.5, -0.5, 1.0, -1.0, 0.25, -0.25, 0.75, -0.75].into_iter().map(move |turn: f64| {
            let (sin, cos) = (turn * std::f64::consts::PI).sin_cos();
            // The side or corner of the name that is nearest lies on the ring.
            let left = x + radius * cos - 0.5 * width * (1.0 - cos);
            let top = y - radius * sin - 0.5 * LINE * (1.0 + sin);
            Frame([left, top, left + width, top + LINE])
        })
    })
}

const OWN_STYLE: &str = "\
.place{stroke:#777;stroke-width:.8}.lead{stroke:#aaa;stroke-width:.6}text.name{font-size:10.5px}\
@media(prefers-color-scheme:dark){.place{stroke:#aaa}.lead{stroke:#666}}";

#[cfg(test)]
mod tests {
    use super::*;

    fn map(places: &[([f64; 2], &str)]) -> Map {
        let place =
            |&(at, name): &([f64; 2], &str)| Place { name: name.to_owned(), at, colour: [255, 0, 10], marked: false };
        Map { title: "a < b".to_owned(), subtitle: String::new(), places: places.iter().map(place).collect() }
    }

    #[test]
    fn names_cover_neither_places_nor_each_other_and_stay_on_the_page() {
        let at = |k: i32| [f64::from(k * 7 % 13) + 0.1 * f64::from(k), f64::from(k * 5 % 11)];
        let names: Vec<([f64; 2], String)> = (0..60).map(|k| (at(k), format!("material-{k}"))).collect();
        let map = map(&names.iter().map(|(at, name)| (*at, name.as_str())).collect::<Vec<_>>());
        let at = map.on_page();
        let labels: Vec<Frame> = map.labels(&at).into_iter().flatten().collect();
        assert!(labels.len() > 50, "{}", labels.len());
        for (i, label) in labels.iter().enumerate() {
            assert!(label.is_inside());
            assert!(labels[..i].iter().all(|other| label.overlap(*other) == 0.0));
            assert!(at.iter().all(|[x, y]| label.overlap(Frame([x - 5.0, y - 5.0, x + 5.0, y + 5.0])) == 0.0));
        }
    }

    #[test]
    fn one_scale_serves_both_directions_and_up_is_up() {
        let at = map(&[([0.0, 0.0], "a"), ([3.0, 0.0], "b"), ([0.0, 1.0], "c")]).on_page();
        assert!((at[1][0] - at[0][0] - 3.0 * (at[0][1] - at[2][1])).abs() < 1e-9 && at[2][1] < at[0][1]);
        let svg = map(&[([0.0, f64::NAN], "x & y")]).svg();
        assert!(svg.starts_with("<svg") && svg.contains("a &lt; b") && svg.contains("x &amp; y"));
        assert!(svg.contains("#ff000a"));
    }
}
