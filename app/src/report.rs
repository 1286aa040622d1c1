//! Reports: JSON or text on stdout.

pub mod heat;
pub mod png;
pub mod saved;
pub mod svg;
pub mod table;

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::Library;
use serde_json::{Value, json};

use crate::command::Global;

/// Prints JSON with `--json`, else the text.
pub fn print(global: &Global, json: &Value, text: impl FnOnce() -> String) -> Result<()> {
    let out = match global.json {
        true => format!("{json:#}\n"),
        false => text(),
    };
    write(&out)
}

/// Writes to stdout; a reader that has seen enough and closed the pipe is no failure.
pub fn write(out: &str) -> Result<()> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(out.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => other.context("standard output"),
    }
}

/// Report of an import.
pub fn imported(library: &Library, output: &Path) -> Value {
    let material = |entry: &nbrdf_core::library::Entry| json!({"name": entry.name, "database": entry.database, "held_out": entry.held_out, "error": entry.error});
    json!({
        "schema": 1,
        "library": output.display().to_string(),
        "materials": library.iter().map(material).collect::<Vec<_>>(),
    })
}

/// A figure with three significant digits or so: `43.0`, `0.995`, `0.0043`.
pub fn figure(value: f64) -> String {
    match value.abs() {
        v if !v.is_finite() => value.to_string(),
        v if v >= 1e4 => format!("{value:.1e}"),
        v if v >= 10.0 => format!("{value:.1}"),
        v if v >= 1.0 => format!("{value:.2}"),
        v if v >= 0.1 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}

/// A number of bytes: `675 bytes`, `4.0 kB`, `35.0 MB`; a kB has 1000 bytes, as in the tables of the documentation.
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1000 => format!("{bytes} bytes"),
        1000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units_of_a_thousand() {
        assert_eq!([999, 4024, 34_992_012].map(size), ["999 bytes", "4.0 kB", "35.0 MB"]);
    }
}
