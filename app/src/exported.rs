//! What is told of files that were written: command line and window tell the same.

mod file_set;

use std::path::PathBuf;

use anyhow::Result;
use nbrdf_core::hash::{sha256, short_hash};
use nbrdf_core::metric::LinearErrors;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Brdf, Database, Material};
use serde_json::{Value, json};

use crate::catalog::exporters::Subject;
use crate::catalog::{Catalog, ExporterEntry};
use crate::command::fit::judge::table_error;
use crate::report;

pub use file_set::FileSet;

/// A file by name, length and checksum.
pub fn file((path, bytes): &(PathBuf, Vec<u8>)) -> Value {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    json!({"name": name, "bytes": bytes.len(), "sha256": sha256(bytes)})
}

/// A material by name, database and network.
pub fn material(name: &str, material: Option<&Material>) -> Value {
    let network = material.and_then(|material| material.network.as_ref());
    let hash = network.map(|network| short_hash(network.weights().iter().copied()));
    json!({"name": name, "database": Database::of(name).to_string(), "network": hash})
}

/// What the files stand for, read again, against what was written: `log_error`, PSNR under `studio`, by how much the mean of
/// linear pictures differs, and which share of their light is in another place (the worst of channels, `point` and `studio`).
///
/// # Errors
/// If the files cannot be read again.
pub fn error(
    form: &ExporterEntry,
    subject: &Subject<'_>,
    files: &[(PathBuf, Vec<u8>)],
    catalog: &Catalog,
) -> Result<Value> {
    let bytes: Vec<&[u8]> = files.iter().map(|(_, bytes)| bytes.as_slice()).collect();
    let read = form.read_back(&bytes, catalog)?;
    let source = subject.material.brdf.as_ref();
    let mut error = table_error(source, read.as_ref(), subject.changes_when_turned());
    let LinearErrors { of_mean, of_pixels } = light_error(source, read.as_ref());
    error["image_mean_error"] = of_mean.into();
    error["image_pixel_error"] = of_pixels.into();
    Ok(error)
}

/// What is written, of which size and how far from its source, as a line; of `material`, `files` and `error`.
pub fn line(told: &Value) -> String {
    let files = told["files"].as_array().map_or(&[][..], Vec::as_slice);
    let names: Vec<&str> = files.iter().filter_map(|file| file["name"].as_str()).collect();
    let bytes: u64 = files.iter().filter_map(|file| file["bytes"].as_u64()).sum();
    let number = |key: &str| told["error"][key].as_f64().unwrap_or(f64::NAN);
    let figure = |key: &str| report::figure(number(key));
    // Infinity is null in JSON.
    let elsewhere = 100.0 * told["error"]["image_pixel_error"].as_f64().unwrap_or(f64::INFINITY);
    let name = told["material"].as_str().unwrap_or_default();
    format!(
        "{name} in {}, {}; log_error {}, studio PSNR {} dB, {elsewhere:.1} % of the light elsewhere\n",
        names.join(", "),
        report::size(bytes),
        figure("log_error"),
        figure("studio_psnr")
    )
}

/// What is to be said where the files are further from their source than the form promises; `error` as told by [`error()`].
pub fn warning(form: &ExporterEntry, error: &Value) -> Option<String> {
    let promised = form.tolerance?;
    // Infinity is null in JSON.
    let found = error["image_pixel_error"].as_f64().unwrap_or(f64::INFINITY);
    let [found_percent, percent] = [found, promised].map(|share| 100.0 * share);
    let told = format!(
        "even the finest {} puts {found_percent:.1} % of a sphere's light in another place, where {percent} % are wanted: its highlights \
         may be narrower than the table's cells; a network or source code keeps them",
        form.name
    );
    (found > promised).then_some(told)
}

/// How far the light of spheres differs, under either standard light.
fn light_error(source: &dyn Brdf, read: &dyn Brdf) -> LinearErrors {
    let of = |sphere: &Sphere| LinearErrors::of(&sphere.render(source), &sphere.render(read), sphere.covered());
    of(Sphere::point()).max(of(Sphere::studio()))
}

/// The manifest of one material that is no point of a walk in the window.
///
/// # Errors
/// As [`error`].
pub fn manifest(
    form: &ExporterEntry,
    subject: &Subject<'_>,
    files: &[(PathBuf, Vec<u8>)],
    catalog: &Catalog,
    command: &str,
) -> Result<Value> {
    let name = &subject.material.name;
    Ok(json!({
        "schema": 1,
        "nbrdf": env!("CARGO_PKG_VERSION"),
        "what": "material",
        "form": form.name,
        "convention": form.convention,
        "material": name,
        "materials": [material(name, Some(subject.material))],
        "code": subject.code,
        "checkpoint": subject.code.map(|code| &code.checkpoint),
        "error": error(form, subject, files, catalog)?,
        "files": files.iter().map(file).collect::<Vec<_>>(),
        "command": command,
    }))
}
