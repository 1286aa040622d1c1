//! Relative variance of uniform, cosine, Blinn–Phong and fitted-lobe sampling of the built-in MERL materials, as JSON.
//!
//! `cargo run --release -p nbrdf-core --example sampling_variance > variance.json`

use std::io::Write;

use nbrdf_core::{Database, Library, library::builtin, sampler::variance::Variances};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let built_in = builtin::shared();
    let entries = built_in.iter().filter(|entry| entry.database == Database::Merl).cloned().collect();
    let library = Library::new(built_in.provenance().clone(), None, entries)?;
    let rows = Variances::of_library(&library);
    let report = serde_json::json!({ "schema": 1, "rows": rows });
    serde_json::to_writer_pretty(std::io::stdout().lock(), &report)?;
    Ok(writeln!(std::io::stdout())?)
}
