//! Comma-separated rows under a heading, one material each.

use std::collections::BTreeSet;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::PublishedFitError;

/// Largest file that is read \[bytes\]: far above 100 rows.
const MAX_FILE: u64 = 16 << 20;
/// Where the name of the material stands.
const NAME: &str = "merl_name";
/// Larger numbers are no parameters; c of the SGD fits reaches 10³⁸.
const LARGEST: f64 = 3e38;

/// The text of a table.
pub(super) struct Table {
    path: PathBuf,
    heading: Vec<String>,
    /// Line and fields.
    rows: Vec<(usize, Vec<String>)>,
}

/// One material.
pub(super) struct Row<'a> {
    table: &'a Table,
    line: usize,
    fields: &'a [String],
}

impl Table {
    pub(super) fn load(path: &Path) -> Result<Self, PublishedFitError> {
        let failed = |source| PublishedFitError::Io { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        std::fs::File::open(path).map_err(failed)?.take(MAX_FILE + 1).read_to_end(&mut bytes).map_err(failed)?;
        if bytes.len() as u64 > MAX_FILE {
            return Err(failed(io::Error::other(format!("expected {MAX_FILE} bytes at most, found more"))));
        }
        Self::parse(path, &String::from_utf8_lossy(&bytes))
    }

    pub(super) fn parse(path: &Path, text: &str) -> Result<Self, PublishedFitError> {
        let text = text.trim_start_matches('\u{feff}');
        let fields = |line: &str| line.split(',').map(|field| field.trim().to_owned()).collect::<Vec<_>>();
        let mut lines =
            text.lines().enumerate().map(|(i, line)| (i + 1, line)).filter(|(_, line)| !line.trim().is_empty());
        let heading = lines.next().map(|(_, line)| fields(line)).unwrap_or_default();
        let table = Self { path: path.to_owned(), heading, rows: lines.map(|(i, line)| (i, fields(line))).collect() };
        table.column(NAME)?;
        if let Some(twice) = twice(table.heading.iter().map(String::as_str)) {
            return Err(table.problem(1, "every column once", format!("{twice} twice")));
        }
        if table.rows.is_empty() {
            return Err(table.problem(2, "a material", "the end".into()));
        }
        Ok(table)
    }

    /// Name and parameters of every row.
    pub(super) fn rows<T>(
        &self,
        parse: impl Fn(&Row) -> Result<T, PublishedFitError>,
    ) -> Result<Vec<(String, T)>, PublishedFitError> {
        let name_at = self.column(NAME)?;
        let mut known = BTreeSet::new();
        let mut found = Vec::with_capacity(self.rows.len());
        for (line, fields) in &self.rows {
            let (expected, count) = (self.heading.len(), fields.len());
            if count != expected {
                return Err(self.problem(*line, &format!("{expected} fields"), count.to_string()));
            }
            let name = &fields[name_at];
            if name.is_empty() {
                return Err(self.problem(*line, "the name of a material", "none".into()));
            }
            if !known.insert(name) {
                return Err(self.problem(*line, "every material once", format!("'{}' again", shown(name))));
            }
            found.push((name.clone(), parse(&Row { table: self, line: *line, fields })?));
        }
        Ok(found)
    }

    fn column(&self, name: &str) -> Result<usize, PublishedFitError> {
        self.heading.iter().position(|column| column == name).ok_or_else(|| {
            let found = if self.heading.is_empty() { "the end".to_owned() } else { shown(&self.heading.join(",")) };
            self.problem(1, &format!("a heading with the column {name}"), found)
        })
    }

    fn problem(&self, line: usize, expected: &str, found: String) -> PublishedFitError {
        PublishedFitError::Line { path: self.path.clone(), line, expected: expected.to_owned(), found }
    }
}

impl Row<'_> {
    /// The number of a column, `least` and more.
    pub(super) fn number(&self, column: &str, least: f64) -> Result<f64, PublishedFitError> {
        let text = &self.fields[self.table.column(column)?];
        let problem = |expected: &str, found| self.table.problem(self.line, &format!("{expected} for {column}"), found);
        match text.parse::<f64>() {
            Ok(value) if !value.is_finite() => Err(problem("a finite number", format!("'{}'", shown(text)))),
            Err(_) => Err(problem("a finite number", format!("'{}'", shown(text)))),
            Ok(value) if value.abs() > LARGEST => {
                Err(problem(&format!("a number of size {LARGEST:e} at most"), format!("{value:e}")))
            }
            Ok(value) if value < least => Err(problem(&format!("at least {least}"), value.to_string())),
            Ok(value) => Ok(value),
        }
    }
}

/// The beginning of what may be long.
fn shown(text: &str) -> String {
    text.chars().take(80).collect()
}

/// A word that is there twice.
fn twice<'a>(words: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let mut words: Vec<&str> = words.collect();
    words.sort_unstable();
    words.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
}
