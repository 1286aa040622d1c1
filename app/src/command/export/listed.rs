//! The forms, listed.

use anyhow::Result;
use serde_json::{Value, json};

use crate::catalog::{EXPORTERS, ExporterEntry};
use crate::command::Global;
use crate::report;

/// Prints every form.
pub(super) fn print(global: &Global) -> Result<()> {
    let row = |entry: &ExporterEntry| -> Value {
        json!({
            "name": entry.name, "extension": entry.extension, "about": entry.about, "needs": entry.needs.name(),
            "convention": entry.convention,
        })
    };
    let summary = json!({"schema": 1, "forms": EXPORTERS.iter().map(row).collect::<Vec<_>>()});
    report::print(global, &summary, || {
        let widest = EXPORTERS.iter().map(|entry| entry.name.len()).max().unwrap_or(0);
        EXPORTERS.iter().map(|entry| format!("{:widest$}  {}\n", entry.name, entry.about)).collect()
    })
}
