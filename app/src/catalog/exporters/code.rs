//! Codes as files.

use nbrdf_core::Code;

use super::entry::first;
use super::{ExporterEntry, Needs};
use crate::material::{decoded, parse_code};

/// A code.
pub(super) const CODE: ExporterEntry = ExporterEntry {
    name: "code",
    extension: "json",
    about: "its code, as `nbrdf encode` writes it",
    needs: Needs::Code,
    convention: "numbers of the model that the file names; it decodes to f_r [1/sr], linear RGB, without the cosine",
    tolerance: None,
    ends: &[".json"],
    write: |subject, _| Ok(subject.code.and_then(json).map(|text| vec![text.into_bytes()])),
    read: |files, catalog| {
        let file = "the code";
        let code = parse_code(file, first(files))?;
        Ok(decoded(catalog, code, file)?.material.brdf)
    },
};

/// A code as its file holds it: one line.
pub fn json(code: &Code) -> Option<String> {
    Some(serde_json::to_string(code).ok()? + "\n")
}
