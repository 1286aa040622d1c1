//! A grid of verdicts: methods down, hazards across, a colour and a sign for each.

use std::fmt::{self, Write};

use super::{escaped, head};

/// Sizes in the picture's own units.
const LEFT: f64 = 212.0;
const SIDE: f64 = 21.0;
const GAP: f64 = 8.0;
const TOP: f64 = 96.0;
/// Room for names that lean.
const NAMES: f64 = 128.0;
const RIGHT: f64 = 84.0;

/// The whole picture.
pub struct Grid {
    /// What was found.
    pub title: String,
    /// How it was measured.
    pub subtitle: String,
    /// Kinds of spots, the best first; four at most.
    pub kinds: Vec<String>,
    /// What a marked spot means.
    pub marked: String,
    /// Grids below each other.
    pub blocks: Vec<Block>,
}

/// Rows and columns that belong together.
pub struct Block {
    /// What the rows are.
    pub title: String,
    /// Names, and the groups they belong to.
    pub columns: Vec<(String, String)>,
    /// Names and spots; where there is none, nothing was measured.
    pub rows: Vec<(String, Vec<Option<Spot>>)>,
}

/// One cell.
pub struct Spot {
    /// Place in the kinds.
    pub kind: usize,
    /// Whether it is marked.
    pub is_marked: bool,
    /// What a pointer over it is told.
    pub about: String,
    /// Where a click leads.
    pub link: String,
}

impl Grid {
    /// The whole file.
    pub fn svg(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let width = self.blocks.iter().map(Block::width).fold(820.0, f64::max);
        let height = TOP + self.blocks.iter().map(Block::height).sum::<f64>() + 8.0;
        head(out, &self.title, &self.subtitle, [width, height], STYLE)?;
        let mut x = 16.0;
        let plain = self.kinds.iter().enumerate().map(|(kind, name)| (kind, false, name));
        for (kind, is_marked, name) in plain.chain([(3, true, &self.marked)]) {
            spot(out, [x, 64.0], kind, is_marked)?;
            writeln!(out, "<text x=\"{:.1}\" y=\"78\">{}</text>", x + SIDE + 4.0, escaped(name))?;
            x += SIDE + 28.0 + 7.0 * name.chars().count() as f64;
        }
        let mut top = TOP;
        for block in &self.blocks {
            block.write(out, top)?;
            top += block.height();
        }
        writeln!(out, "</svg>")
    }
}

impl Block {
    fn width(&self) -> f64 {
        self.x(self.columns.len()) + RIGHT
    }

    fn height(&self) -> f64 {
        NAMES + SIDE * self.rows.len() as f64 + 16.0
    }

    /// Left side of a column: groups stand apart.
    fn x(&self, column: usize) -> f64 {
        let changes = self.columns.windows(2).take(column.min(self.columns.len().saturating_sub(1)));
        LEFT + SIDE * column as f64 + GAP * changes.filter(|pair| pair[0].1 != pair[1].1).count() as f64
    }

    fn write(&self, out: &mut String, top: f64) -> fmt::Result {
        let rows = top + NAMES;
        writeln!(out, "<text class=\"block\" x=\"16\" y=\"{:.1}\">{}</text>", rows - 8.0, escaped(&self.title))?;
        let mut group = "";
        for (column, (name, own)) in self.columns.iter().enumerate() {
            let (x, y) = (self.x(column) + 0.5 * SIDE + 4.0, rows - 6.0);
            writeln!(
                out,
                "<text class=\"name\" transform=\"translate({x:.1} {y:.1}) rotate(-52)\">{}</text>",
                escaped(name)
            )?;
            if own != group {
                let x = self.x(column);
                writeln!(out, "<text class=\"group\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>", top + 14.0, escaped(own))?;
            }
            group = own;
        }
        for (row, (name, spots)) in self.rows.iter().enumerate() {
            let y = rows + SIDE * row as f64;
            let x = LEFT - 8.0;
            writeln!(out, "<text class=\"tick\" x=\"{x}\" y=\"{:.1}\">{}</text>", y + 15.0, escaped(name))?;
            for (column, found) in spots.iter().enumerate() {
                let place = [self.x(column), y];
                let Some(found) = found else {
                    let [x, y] = place.map(|v| v + 0.5 * SIDE);
                    writeln!(out, "<circle class=\"none\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"1.2\"/>")?;
                    continue;
                };
                write!(out, "<a href=\"{}\"><title>{}</title>", escaped(&found.link), escaped(&found.about))?;
                spot(out, place, found.kind, found.is_marked)?;
                writeln!(out, "</a>")?;
            }
        }
        Ok(())
    }
}

/// A square of its kind's colour with its kind's sign, so that colours are not all there is.
fn spot(out: &mut String, [x, y]: [f64; 2], kind: usize, is_marked: bool) -> fmt::Result {
    let (side, half) = (SIDE - 2.0, 0.5 * SIDE);
    let (cx, cy) = (x + half, y + half);
    let sign = match kind {
        0 => String::new(),
        1 => format!("<path class=\"sign\" d=\"M{:.1} {cy:.1}h8\"/>", cx - 4.0),
        2 => format!("<circle class=\"sign\" cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"3.2\"/>"),
        _ => format!("<path class=\"sign\" d=\"M{:.1} {:.1}l8 8m0 -8l-8 8\"/>", cx - 4.0, cy - 4.0),
    };
    let frame = if is_marked { " told" } else { "" };
    write!(
        out,
        "<rect class=\"k{kind}{frame}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{side}\" height=\"{side}\" rx=\"3\"/>{sign}",
        x + 1.0,
        y + 1.0
    )
}

/// Colours that keep apart for most kinds of colour vision (M. Okabe, K. Ito, *Color Universal Design*, 2002).
const STYLE: &str = "\
text{font:13px system-ui,sans-serif;fill:#222}.title{font-size:17px;font-weight:600}.quiet,.group{fill:#666}\
.block{font-weight:600}.tick{text-anchor:end;fill:#333}.name{fill:#333}.page{fill:#fff}.none{fill:#bbb}\
.k0{fill:#cfe8de}.k1{fill:#b9cfe6}.k2{fill:#f3c969}.k3{fill:#d55e00}\
.told{fill:#f0a884;stroke:#d55e00;stroke-width:2}.sign{fill:none;stroke:#222;stroke-width:1.6}\
@media(prefers-color-scheme:dark){text{fill:#e6e6e6}.quiet,.group{fill:#aaa}.tick,.name{fill:#ccc}.page{fill:#16181c}\
.none{fill:#555}.k0{fill:#1f4a3c}.k1{fill:#2c4a6b}.k2{fill:#b98a1e}.k3{fill:#d55e00}\
.told{fill:#6b3317;stroke:#ff8b3d}.sign{stroke:#f2f2f2}}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spot_is_drawn_with_its_kind_and_groups_stand_apart() {
        let spot = |kind, is_marked| Some(Spot { kind, is_marked, about: "a < b".into(), link: "#h".into() });
        let columns = [("one", "x"), ("two", "x"), ("three", "y")];
        let columns = columns.map(|(name, group)| (name.to_owned(), group.to_owned())).to_vec();
        let rows = vec![("method".to_owned(), vec![spot(0, false), None, spot(3, true)])];
        let block = Block { title: "methods".into(), columns, rows };
        assert!(block.x(2) - block.x(1) > block.x(1) - block.x(0));
        let kinds = ["a", "b", "c", "d"].map(str::to_owned).to_vec();
        let grid = Grid { title: "t".into(), subtitle: "s".into(), kinds, marked: "m".into(), blocks: vec![block] };
        let svg = grid.svg();
        assert_eq!(svg.matches("<a href").count(), 2);
        assert_eq!(svg.matches("class=\"none\"").count(), 1);
        assert!(svg.contains("a &lt; b") && svg.contains("class=\"k3 told\""));
    }
}
