//! Scenes that the program carries, so that there is always one to look at.

use std::sync::Arc;

use anyhow::{Context, Result};

use super::Source;
use crate::catalog::Catalog;
use crate::measure::planned::Opened;

/// Name, file, and what it is, for people.
pub const EXAMPLES: [(&str, &str, &str); 2] = [
    ("shelf", include_str!("../../../../scenes/shelf.toml"), "Twelve materials at mixed distances"),
    ("metal", include_str!("../../../../scenes/metal.toml"), "Three metals close to the camera"),
];

/// What they include.
const STUDIO: (&str, &str) = ("studio.toml", include_str!("../../../../scenes/studio.toml"));

/// Reads a scene and what it names; its models learn from this catalog.
pub fn open(source: &Source, catalog: &Arc<Catalog>) -> Result<Opened> {
    let name = match source {
        Source::File(path) => return Opened::load(path, None, &[], catalog),
        Source::Example(name) => name,
    };
    let known = EXAMPLES.iter().find(|(known, ..)| known == name);
    let (name, text, _) = known.with_context(|| format!("there is no example '{name}'"))?;
    // Scenes are read from files, which include others.
    let folder = tempfile::tempdir().context("an example needs a folder for a moment")?;
    let path = folder.path().join(format!("{name}.toml"));
    for (file, text) in [(path.as_path(), *text), (&folder.path().join(STUDIO.0), STUDIO.1)] {
        std::fs::write(file, text).with_context(|| file.display().to_string())?;
    }
    Opened::load(&path, None, &[], catalog)
}
