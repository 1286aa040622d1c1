//! The files of one material in one form, its manifest among them.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use nbrdf_core::atomic;
use serde_json::Value;

use super::{file as told, manifest, warning};
use crate::catalog::exporters::Subject;
use crate::catalog::{Catalog, ExporterEntry};
use crate::command::Global;
use crate::failure::Failure;
use crate::output;

/// Bytes of a manifest that is looked into: one has some thousands.
const MOST_MANIFEST: u64 = 1 << 20;

/// Names of the files of one material in one form, its manifest among them.
pub struct FileSet {
    /// The form.
    pub form: &'static ExporterEntry,
    /// What all names begin with.
    pub stem: PathBuf,
    /// Whether somebody has named the file, rather than a folder for it.
    pub is_named: bool,
}

/// What the files are to hold.
pub struct Made {
    /// What is told of them.
    pub manifest: Value,
    files: Vec<(PathBuf, Vec<u8>)>,
}

impl FileSet {
    /// The path that means all of them on a command line.
    pub fn named(&self) -> PathBuf {
        self.beside(self.form.extension)
    }

    /// The manifest's file: other forms of the same stem keep theirs.
    pub fn manifest(&self) -> PathBuf {
        self.beside(&format!("{}.manifest.json", self.form.extension))
    }

    /// All files, the manifest first.
    pub fn paths(&self) -> Vec<PathBuf> {
        std::iter::once(self.manifest()).chain(self.form.paths(&self.stem)).collect()
    }

    /// Refuses to write over what is read, and where nothing can be written. The file that is named may be replaced; those that
    /// come with it only where they are as an earlier export left them.
    ///
    /// # Errors
    /// Which file.
    pub fn check(&self, inputs: &[String]) -> Result<()> {
        self.paths().iter().try_for_each(|path| self.check_path(path, inputs))
    }

    fn check_path(&self, path: &Path, inputs: &[String]) -> Result<()> {
        output::check_no_input(path, inputs)?;
        let is_meant = path == self.manifest() || self.is_named && path == self.named();
        if !is_meant && path.is_file() && !self.is_own(path) {
            let path = path.display();
            return Err(Failure::Usage(format!(
                "{path}: is there, is not as an export left it, and would be written over: move it, or choose another name"
            ))
            .into());
        }
        output::check_writable(path)
    }

    /// Whether the manifest that is there tells of such a file.
    fn is_own(&self, path: &Path) -> bool {
        let length = |path: &Path| path.metadata().ok().filter(|found| found.is_file()).map(|found| found.len());
        if length(&self.manifest()).is_none_or(|length| length > MOST_MANIFEST) {
            return false;
        }
        let manifest = std::fs::read(self.manifest()).ok().and_then(|text| serde_json::from_slice::<Value>(&text).ok());
        let files = manifest.as_ref().and_then(|manifest| manifest["files"].as_array()).map_or(&[][..], Vec::as_slice);
        // What is of another length need not be read.
        let is_as_long =
            files.iter().any(|file| file["bytes"].as_u64().is_some_and(|bytes| length(path) == Some(bytes)));
        is_as_long && std::fs::read(path).is_ok_and(|bytes| files.contains(&told(&(path.to_owned(), bytes))))
    }

    /// What the files are to hold, and how far that is from the material; people are warned where it is too far.
    ///
    /// # Errors
    /// That the material lacks what the form needs, or that what was made cannot be read again.
    pub fn make(&self, subject: &Subject<'_>, catalog: &Catalog, command: &str, global: &Global) -> Result<Made> {
        let files = self.form.files(&self.stem, subject)?;
        let manifest = manifest(self.form, subject, &files, catalog, command)?;
        if let Some(told) = warning(self.form, &manifest["error"]) {
            global.warn(format_args!("{}: {told}", subject.material.name))?;
        }
        Ok(Made { manifest, files })
    }

    /// Writes all of them, or none.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn write(&self, made: Made) -> Result<()> {
        let text = format!("{:#}\n", made.manifest).into_bytes();
        let all: Vec<_> = std::iter::once((self.manifest(), text)).chain(made.files).collect();
        atomic::write_together(&all).with_context(|| format!("{}: cannot be written", self.named().display()))
    }

    fn beside(&self, end: &str) -> PathBuf {
        let mut name = self.stem.as_os_str().to_owned();
        name.push(format!(".{end}"));
        name.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manifest_comes_first_and_keeps_off_other_forms() {
        let set =
            |form: &str| FileSet { form: ExporterEntry::named(form).unwrap(), stem: "a/v1.b".into(), is_named: true };
        let names = ["a/v1.b.bsdf.manifest.json", "a/v1.b.bsdf", "a/v1.b.xml"];
        assert_eq!(set("bsdf").paths(), names.map(PathBuf::from));
        assert_eq!(set("npy").named(), Path::new("a/v1.b.npy"));
        assert_ne!(set("npy").manifest(), set("npz").manifest());
    }
}
