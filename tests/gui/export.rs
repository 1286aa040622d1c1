//! Files that are written from the window.

#[path = "export/materials.rs"]
mod materials;
#[path = "export/pictures.rs"]
mod pictures;
#[path = "export/refusals.rs"]
mod refusals;
#[path = "export/walks.rs"]
mod walks;

use std::path::Path;

use nbrdf::gui::session::{Export, What};
use nbrdf_core::hash::sha256;
use serde_json::Value;

use super::*;

/// A session that writes small files named `out` into this folder.
fn writing(folder: &Path) -> Session {
    let folder = folder.display().to_string();
    Session { export: Export { folder, name: "out".to_owned(), size: 32, steps: 3, ..Export::default() }, ..quick() }
}

/// Opens the window and chooses what is written.
fn choose(harness: &mut Harness<'_, Workbench>, what: What) {
    if harness.query_by_label("Write files").is_none() && harness.query_by_label("Export to files").is_none() {
        harness.get_by_label("Export").click();
        harness.run_steps(3);
    }
    harness.get_by_label(what.about()[0]).click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.export.what, what);
    looked(harness);
}

/// Waits until the files that are there are known.
fn looked(harness: &mut Harness<'_, Workbench>) {
    until(harness, "the files are looked for", |bench| {
        let paths = bench.session.job(false).map(|job| job.paths());
        bench.gallery.files.there.as_ref().is_some_and(|[asked, _]| Ok(asked) == paths.as_ref())
    });
}

/// Presses the button and waits for the end.
fn write(harness: &mut Harness<'_, Workbench>) -> String {
    let before = harness.state().gallery.files.ended;
    harness.get_by_label("Write files").click();
    harness.run_steps(2);
    until(harness, "the files are written", |bench| bench.gallery.files.ended > before);
    harness.state_mut().gallery.notices.pop().unwrap_or_default()
}

/// The manifest, which must be right about every file.
fn manifest(folder: &Path) -> Value {
    let text = std::fs::read(folder.join("out.manifest.json")).unwrap();
    let manifest: Value = serde_json::from_slice(&text).unwrap();
    let files = manifest["files"].as_array().unwrap();
    assert!(!files.is_empty());
    for file in files {
        let bytes = std::fs::read(folder.join(file["name"].as_str().unwrap())).unwrap();
        assert_eq!(file["sha256"], sha256(&bytes), "{file}");
    }
    manifest
}
