//! The numbers that are shown.

use crate::worker::Card;

/// A table: one row per point of a curve, or per model.
pub struct Sheet {
    /// Names of the columns, with units.
    pub columns: Vec<String>,
    /// Curves.
    pub curves: Vec<Curve>,
    /// Rows of plain tables, which have no curves.
    pub rows: Vec<Vec<String>>,
}

/// The points of one curve.
#[derive(Clone)]
pub struct Curve {
    /// Whose.
    pub card: Card,
    /// Its name for people.
    pub title: String,
    /// Finite numbers.
    pub points: Vec<[f64; 2]>,
}

impl Sheet {
    /// Curves over `x`, both axes with their units.
    pub fn of_curves(x: &str, y: &str, curves: Vec<Curve>) -> Self {
        Self { columns: vec!["curve".to_owned(), x.to_owned(), y.to_owned()], curves, rows: Vec::new() }
    }

    /// Plain rows.
    pub fn of_rows(columns: &[&str], rows: Vec<Vec<String>>) -> Self {
        Self { columns: columns.iter().map(|&column| column.to_owned()).collect(), curves: Vec::new(), rows }
    }

    /// Whether there is nothing to see.
    pub fn is_empty(&self) -> bool {
        self.curves.iter().all(|curve| curve.points.is_empty()) && self.rows.is_empty()
    }

    /// Name of the horizontal axis.
    pub fn x(&self) -> &str {
        self.columns.get(1).map_or("", String::as_str)
    }

    /// Name of the vertical axis.
    pub fn y(&self) -> &str {
        self.columns.get(2).map_or("", String::as_str)
    }

    /// As comma-separated values (RFC 4180).
    pub fn csv(&self) -> String {
        let points = self.curves.iter().flat_map(|curve| {
            curve.points.iter().map(|[x, y]| vec![curve.title.clone(), x.to_string(), y.to_string()])
        });
        let lines = std::iter::once(self.columns.clone()).chain(points).chain(self.rows.iter().cloned());
        lines.map(|cells| cells.iter().map(|cell| quoted(cell)).collect::<Vec<_>>().join(",") + "\r\n").collect()
    }
}

fn quoted(cell: &str) -> String {
    match cell.contains([',', '"', '\r', '\n']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_commas_and_quotes_stay_one_cell() {
        let curve = Curve { card: Card::End(0), title: "Latent, \"even\"".to_owned(), points: vec![[0.5, 34.25]] };
        let sheet = Sheet::of_curves("t", "PSNR [dB]", vec![curve]);
        assert_eq!(sheet.csv(), "curve,t,PSNR [dB]\r\n\"Latent, \"\"even\"\"\",0.5,34.25\r\n");
    }
}
