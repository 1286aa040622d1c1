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
