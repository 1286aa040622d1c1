//! What is written to files, and where to.

mod job;
mod what;

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

pub use what::What;

use super::letter;
use crate::catalog::{EXPORTERS, ExporterEntry};
use crate::worker::Card;
use crate::worker::export::PictureForm;

/// Pixels per side of a sphere, at least and at most.
pub const SIZES: [u16; 2] = [16, 1024];
/// Points of a walk, at least and at most.
pub const STEPS: [u16; 2] = [2, 64];

/// What is written, and where to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Export {
    /// What of it.
    pub what: What,
    /// Whose: the letter of an end, or the catalog name of a method.
    pub card: String,
    /// Form of materials, by the name of the exporter.
    pub form: String,
    /// Form of pictures.
    pub picture: PictureForm,
    /// Pixels per side of a sphere.
    pub size: u16,
    /// Points of a walk, ends included.
    pub steps: u16,
    /// The folder; empty for the user's own.
    pub folder: String,
    /// What all files' names begin with; empty for the names of the materials.
    pub name: String,
}

impl Default for Export {
    fn default() -> Self {
        Self {
            what: What::default(),
            card: String::new(),
            form: EXPORTERS[0].name.to_owned(),
            picture: PictureForm::default(),
            size: 512,
            steps: 9,
            folder: String::new(),
            name: String::new(),
        }
    }
}

/// How a card is called in [`Export::card`].
pub fn name_of(card: Card) -> String {
    match card {
        Card::End(end) => letter(end).to_string(),
        Card::Method(method) => method.to_owned(),
        Card::Explored => "explored".to_owned(),
    }
}

impl Export {
    /// The form of materials; the first where a file of another version knows more.
    pub fn exporter(&self) -> &'static ExporterEntry {
        ExporterEntry::named(&self.form).unwrap_or(&EXPORTERS[0])
    }

    /// The folder, absolute.
    pub fn folder(&self) -> PathBuf {
        let home = || std::env::home_dir().unwrap_or_default();
        match self.folder.trim() {
            "" => home(),
            own => own.strip_prefix("~/").map_or_else(|| PathBuf::from(own), |rest| home().join(rest)),
        }
    }
}
