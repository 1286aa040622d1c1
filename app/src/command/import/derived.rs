//! What a library is made from.

use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::hash::sha256;
use nbrdf_core::library::Source;

/// A source by its name, without folders.
pub(super) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// SHA-256 of the published archives, by which they are recognised.
const PUBLISHED: [&str; 2] = [
    "de79644946de1870f2dea6805ae8b4bdaa36bc55c33ef5a135223bdfcdb3ab80",
    "40995a4de63af018c3d93f1589d102170e7cd16a4f6c91e6a798656bce013a2c",
];

/// What a source is, who published it, on which terms.
pub(super) fn derived(path: &Path) -> Result<Source> {
    let sum = match path.is_file() {
        true => sha256(&std::fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))?),
        false => String::new(),
    };
    let (source, terms) = match PUBLISHED.contains(&sum.as_str()) {
        true => (
            "Sztrajman, Rainer, Ritschel, Weyrich 2021, Neural BRDF Representation and Importance Sampling, \
             doi 10.1111/cgf.14335: published network weights",
            "MIT; the measurements behind them: MERL BRDF database (Matusik et al. 2003), \
             RGL material database (Dupuy and Jakob 2018)",
        ),
        false => ("not known to this program", "ask who made it"),
    };
    Ok(Source { file: file_name(path), sha256: sum, source: source.into(), terms: terms.into() })
}
