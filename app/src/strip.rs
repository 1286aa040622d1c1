//! The picture of a walk: one row of spheres per method, labelled, on a dark neutral ground.

mod cell;
pub(crate) mod text;

use nbrdf_core::{Image, Rgb};

pub use cell::Cell;
use text::{Face, Text, ink};

/// What the picture shows; `spheres` of all rows are square and of one size.
pub struct Strip {
    /// What is walked between.
    pub heading: String,
    /// Under which light, and the like.
    pub remark: String,
    /// Label of each column.
    pub columns: Vec<String>,
    /// The methods.
    pub rows: Vec<Row>,
}

/// One method.
pub struct Row {
    /// Name for people.
    pub title: String,
    /// Name on the command line.
    pub name: String,
    /// One sphere per column.
    pub spheres: Vec<Image>,
}

/// The ground, as displayed: dark, yet lighter than a black material.
const GROUND: f32 = 0.135;
pub(crate) const BRIGHT: f32 = 0.93;
pub(crate) const MUTED: f32 = 0.58;
const RULE: f32 = 0.22;
/// Size of the columns' labels \[pixels\].
const COLUMN: f32 = 15.5;

/// What spheres are to be drawn on.
pub fn ground() -> Rgb {
    ink(GROUND)
}

/// Distances in pixels, in proportion to the spheres.
struct Layout {
    cell: usize,
    unit: f32,
    labels: usize,
    /// Width of a column: a sphere's, or that of a wider label.
    column: usize,
}

impl Layout {
    fn new(strip: &Strip) -> Self {
        let cell = strip.rows.first().and_then(|row| row.spheres.first()).map_or(1, Image::width);
        // Small spheres keep legible labels.
        let unit = (cell as f32 / 128.0).max(0.75);
        let (title, name) = (Text::new(Face::Sans, 21.0 * unit), Text::new(Face::Mono, 12.5 * unit));
        let width = |row: &Row| title.width(&row.title).max(name.width(&row.name));
        let labels = strip.rows.iter().map(width).fold(0.0, f32::max).ceil() as usize;
        let heading = Text::new(Face::Sans, COLUMN * unit);
        let widest = strip.columns.iter().map(|label| heading.width(label)).fold(0.0, f32::max).ceil() as usize;
        Self { cell, unit, labels, column: cell.max(widest) }
    }

    fn scaled(&self, pixels: f32) -> usize {
        (pixels * self.unit).round() as usize
    }

    fn margin(&self) -> usize {
        self.scaled(44.0)
    }

    fn left(&self, column: usize) -> usize {
        self.margin()
            + self.labels
            + self.scaled(36.0)
            + column * (self.column + self.scaled(18.0))
            + (self.column - self.cell) / 2
    }

    fn top(&self, row: usize) -> usize {
        self.margin() + self.scaled(96.0) + row * (self.cell + self.scaled(22.0))
    }

    fn size(&self, strip: &Strip, heading: f32) -> (usize, usize) {
        let columns = strip.columns.len().max(1);
        let width = (self.left(columns - 1) + self.column).max(self.margin() + heading.ceil() as usize);
        let height = self.top(strip.rows.len().max(1) - 1) + self.cell;
        (width + self.margin(), height + self.margin())
    }
}

impl Strip {
    /// What a walk between these materials is headed by.
    pub fn heading_of<T: AsRef<str>>(ends: &[T]) -> String {
        let names: Vec<&str> = ends.iter().map(AsRef::as_ref).collect();
        names.join(if names.len() == 2 { " to " } else { ", " })
    }

    /// What is said of its light, and of its exposure \[stops\].
    pub fn remark_of(light: &str, exposure: f32) -> String {
        let exposure = if exposure == 0.0 { String::new() } else { format!(", {exposure:+} stops") };
        format!("{light} light{exposure}")
    }

    /// With labels; spheres are expected to be drawn on [`ground`].
    pub fn labelled(&self) -> Image {
        let layout = Layout::new(self);
        let text = |face, size: f32| Text::new(face, size * layout.unit);
        let heading = text(Face::Sans, 30.0);
        let remark = text(Face::Sans, 15.0);
        let widest = heading.width(&self.heading).max(remark.width(&self.remark));
        let (width, height) = layout.size(self, widest);
        let mut picture = Image::new(width, height, vec![ground(); width * height]);
        let left = layout.margin() as f32;
        let below = |pixels: f32| left + pixels * layout.unit;
        heading.draw(&mut picture, &self.heading, left, below(22.0), BRIGHT);
        remark.draw(&mut picture, &self.remark, left, below(48.0), MUTED);
        let column = text(Face::Sans, COLUMN);
        for (index, label) in self.columns.iter().enumerate() {
            let middle = (layout.left(index) + layout.cell / 2) as f32;
            column.draw(&mut picture, label, middle - column.width(label) / 2.0, below(80.0), MUTED);
        }
        for (index, row) in self.rows.iter().enumerate() {
            self.draw_row(&mut picture, &layout, index, row);
        }
        picture
    }

    fn draw_row(&self, picture: &mut Image, layout: &Layout, index: usize, row: &Row) {
        let (top, left) = (layout.top(index), layout.margin());
        if index > 0 {
            let (y, end) = (top - layout.scaled(11.0), picture.width() - layout.margin());
            let width = picture.width();
            picture.pixels_mut()[y * width + left..y * width + end].fill(ink(RULE));
        }
        let middle = (top + layout.cell / 2) as f32;
        let (title, name) = (Text::new(Face::Sans, 21.0 * layout.unit), Text::new(Face::Mono, 12.5 * layout.unit));
        title.draw(picture, &row.title, left as f32, middle, BRIGHT);
        name.draw(picture, &row.name, left as f32, middle + 20.0 * layout.unit, MUTED);
        for (column, sphere) in row.spheres.iter().enumerate() {
            picture.paste(sphere, layout.left(column), top);
        }
    }

    /// Spheres only, for pictures that are computed with.
    pub fn plain(&self) -> Image {
        let rows: Vec<Image> = self.rows.iter().map(|row| Image::beside(&row.spheres, 0)).collect();
        Image::stacked(&rows, 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(size: usize) -> Strip {
        let white = Image::new(size, size, vec![Rgb::splat(1.0); size * size]);
        let row = |title: &str| Row { title: title.into(), name: "name".into(), spheres: vec![white.clone(); 3] };
        Strip {
            heading: "chrome to rgl/paper_white".into(),
            remark: "studio".into(),
            columns: ["0", "0.5", "1"].map(Into::into).to_vec(),
            rows: vec![row("Latent"), row("A title much longer than that")],
        }
    }

    #[test]
    fn every_sphere_is_whole_in_the_picture_and_no_label_covers_it() {
        for size in [16, 128, 200] {
            let picture = strip(size).labelled();
            let white = picture.pixels().iter().filter(|pixel| **pixel == Rgb::splat(1.0)).count();
            assert_eq!(white, 6 * size * size);
        }
    }

    #[test]
    fn a_plain_strip_is_nothing_but_spheres() {
        let plain = strip(16).plain();
        assert_eq!((plain.width(), plain.height()), (48, 32));
    }
}
