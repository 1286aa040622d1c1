//! A form in the list.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::Brdf;

use super::{EXPORTERS, Subject};
use crate::catalog::Catalog;
use crate::failure::Failure;

/// What a form needs of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// Its reflectance: every material will do.
    Reflectance,
    /// That it is a network.
    Network,
    /// That it has a code.
    Code,
}

impl Needs {
    /// Its name in lists.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reflectance => "reflectance",
            Self::Network => "network",
            Self::Code => "code",
        }
    }
}

/// The bytes of each file of a material; `stem` is what the names of all of them begin with. None where the material lacks
/// what is needed.
type Write = fn(subject: &Subject<'_>, stem: &str) -> Result<Option<Vec<Vec<u8>>>>;
/// What the bytes of all files, in their order, stand for.
type Read = fn(files: &[&[u8]], catalog: &Catalog) -> Result<Arc<dyn Brdf>>;

/// A form in the list.
pub struct ExporterEntry {
    /// Name in lists, in sessions and in manifests.
    pub name: &'static str,
    /// Extension of the file that is named to mean this form, without the dot.
    pub extension: &'static str,
    /// One line for people.
    pub about: &'static str,
    /// What it needs.
    pub needs: Needs,
    /// What the numbers in its files mean: unit, scale, and whether the cosine is in them.
    pub convention: &'static str,
    /// How far pictures may be from the source's ([`LinearErrors::of_pixels`]) before people are warned.
    ///
    /// [`LinearErrors::of_pixels`]: nbrdf_core::metric::LinearErrors::of_pixels
    pub tolerance: Option<f64>,
    /// What the names of its files end with, after the stem.
    pub(super) ends: &'static [&'static str],
    /// Makes the files.
    pub(super) write: Write,
    /// Reads them again, as whoever gets them would; of a program its numbers alone.
    pub(super) read: Read,
}

impl ExporterEntry {
    /// The form of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        EXPORTERS.iter().find(|entry| entry.name == name)
    }

    /// The form of this path's extension.
    pub fn of(path: &Path) -> Option<&'static Self> {
        let extension = path.extension()?.to_str()?;
        EXPORTERS.iter().find(|entry| entry.extension == extension)
    }

    /// The files that a material becomes, from their common stem: `a/chrome` is `a/chrome.npz`, or `a/chrome_fc1.npy`
    /// and five more.
    pub fn paths(&self, stem: &Path) -> Vec<PathBuf> {
        let named = |end: &&str| {
            let mut name = stem.as_os_str().to_owned();
            name.push(end);
            PathBuf::from(name)
        };
        self.ends.iter().map(named).collect()
    }

    /// The files and what they are to hold.
    ///
    /// # Errors
    /// That the material lacks what the form needs.
    pub fn files(&self, stem: &Path, subject: &Subject<'_>) -> Result<Vec<(PathBuf, Vec<u8>)>> {
        let name = stem.file_name().unwrap_or_default().to_string_lossy();
        let bytes = (self.write)(subject, &name)?.ok_or_else(|| self.lacks(subject))?;
        Ok(self.paths(stem).into_iter().zip(bytes).collect())
    }

    /// Refuses a material that plainly lacks what the form needs, before anything is made.
    ///
    /// # Errors
    /// What it lacks.
    pub fn check(&self, subject: &Subject<'_>) -> Result<()> {
        let has = match self.needs {
            // Whether it changes when it is turned takes longer to see, and is told by whoever tabulates.
            Needs::Reflectance => true,
            Needs::Network => subject.network().is_some() || subject.turning().is_some(),
            Needs::Code => subject.code.is_some(),
        };
        if has { Ok(()) } else { Err(self.lacks(subject).into()) }
    }

    /// The user's choice of form is what does not fit, not a file.
    fn lacks(&self, subject: &Subject<'_>) -> Failure {
        let (name, form) = (&subject.material.name, self.name);
        Failure::Usage(match self.needs {
            Needs::Reflectance => format!("{name} changes when it is turned, which {form} cannot say"),
            Needs::Network => format!("{name} is no network, as {form} needs one: choose another form"),
            Needs::Code => format!("{name} has no code: `nbrdf encode` makes one of a material"),
        })
    }

    /// What such files stand for, as whoever reads them would find it.
    ///
    /// # Errors
    /// If they are no files of this form.
    pub fn read_back(&self, files: &[&[u8]], catalog: &Catalog) -> Result<Arc<dyn Brdf>> {
        (self.read)(files, catalog)
    }
}

/// The first file's bytes; none are no file of any form.
pub(super) fn first<'a>(files: &[&'a [u8]]) -> &'a [u8] {
    files.first().copied().unwrap_or_default()
}
