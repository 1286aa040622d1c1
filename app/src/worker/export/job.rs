//! Files to be written: what of what, and where to.

use std::path::PathBuf;

use serde_json::Value;

use super::Goods;
use crate::worker::Request;

/// Files to be written.
pub struct Job {
    /// What is written.
    pub goods: Goods,
    /// What the window shows.
    pub shown: Request,
    /// Where on the path; none in a polygon.
    pub t: Option<f32>,
    /// The folder.
    pub folder: PathBuf,
    /// What the names of all files begin with.
    pub name: String,
    /// Whether files that are there may be replaced.
    pub is_replacing: bool,
    /// What the user chose, for the manifest.
    pub chosen: Value,
    /// The command that makes the same, or why there is none.
    pub command: Result<String, String>,
}

impl Job {
    /// The file that tells what the others are.
    pub fn manifest(&self) -> PathBuf {
        self.folder.join(format!("{}.manifest.json", self.name))
    }

    /// All files, the manifest first.
    pub fn paths(&self) -> Vec<PathBuf> {
        let one = |extension: &str| vec![self.folder.join(format!("{}.{extension}", self.name))];
        let files = match self.goods {
            Goods::Material { form, .. } => form.paths(&self.folder.join(&self.name)),
            Goods::Steps { form, steps, .. } => (0..steps).flat_map(|step| form.paths(&self.step(step))).collect(),
            Goods::Picture { form, .. } | Goods::Strip { form, .. } => one(form.extension()),
            Goods::Curve { .. } => one("csv"),
        };
        std::iter::once(self.manifest()).chain(files).collect()
    }

    /// The only file beside the manifest.
    pub(super) fn file(&self, extension: &str) -> PathBuf {
        self.folder.join(format!("{}.{extension}", self.name))
    }

    /// Stem of the file of a step.
    pub(super) fn step(&self, step: u16) -> PathBuf {
        self.folder.join(format!("{}_{step:02}", self.name))
    }
}
