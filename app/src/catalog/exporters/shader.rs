//! Networks as source code, and as a page that draws with it.

use std::sync::Arc;

use anyhow::{Context, Result};
use nbrdf_core::brdf::Azimuth;
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::shader::{Language, Shader, read};

use super::entry::first;
use super::{ExporterEntry, Needs, Subject};

/// What the functions return.
const VALUES: &str = "a function of two unit vectors, light and view, in a frame whose +z is the normal: f_r [1/sr], linear RGB, \
                      without the cosine, 0 below the horizon";

/// GLSL.
pub(super) const GLSL: ExporterEntry = ExporterEntry {
    about: "a network: one function in GLSL, the weights in it",
    ends: &[".glsl"],
    write: |subject, _| source(subject, Language::Glsl),
    ..of(Language::Glsl)
};

/// HLSL.
pub(super) const HLSL: ExporterEntry = ExporterEntry {
    about: "a network: one function in HLSL, the weights in it",
    ends: &[".hlsl"],
    write: |subject, _| source(subject, Language::Hlsl),
    ..of(Language::Hlsl)
};

/// WGSL.
pub(super) const WGSL: ExporterEntry = ExporterEntry {
    about: "a network: one function in WGSL, the weights in it",
    ends: &[".wgsl"],
    write: |subject, _| source(subject, Language::Wgsl),
    ..of(Language::Wgsl)
};

/// C99.
pub(super) const C: ExporterEntry = ExporterEntry {
    about: "a network: one function in C, the weights in it",
    ends: &[".c"],
    write: |subject, _| source(subject, Language::C),
    ..of(Language::C)
};

/// Rust.
pub(super) const RUST: ExporterEntry = ExporterEntry {
    about: "a network: one function in Rust, the weights in it",
    ends: &[".rs"],
    write: |subject, _| source(subject, Language::Rust),
    ..of(Language::Rust)
};

/// A page with a sphere.
pub(super) const PAGE: ExporterEntry = ExporterEntry {
    name: "html",
    extension: "html",
    about: "a network: a page with a sphere that is drawn in the browser",
    needs: Needs::Network,
    convention: VALUES,
    tolerance: None,
    ends: &[".html"],
    write: |subject, _| Ok(shader(subject).map(|shader| vec![shader.page().into_bytes()])),
    read: |files, _| {
        let text = std::str::from_utf8(first(files)).context("expected text in UTF-8")?;
        Ok(match read(text)? {
            (network, Azimuth::Dropped) => Arc::new(network),
            (network, Azimuth::Kept) => Arc::new(AnisotropicNbrdf::of(network)),
        })
    },
};

/// What all languages share.
const fn of(language: Language) -> ExporterEntry {
    let extension = language.extension();
    ExporterEntry { name: extension, extension, convention: VALUES, ..PAGE }
}

fn source(subject: &Subject<'_>, language: Language) -> Result<Option<Vec<Vec<u8>>>> {
    Ok(shader(subject).map(|shader| vec![shader.source(language).into_bytes()]))
}

fn shader(subject: &Subject<'_>) -> Option<Shader> {
    let name = &subject.material.name;
    match subject.network() {
        Some(network) => Some(Shader::new(name, network)),
        None => Some(Shader::turning(name, subject.turning()?)),
    }
}
