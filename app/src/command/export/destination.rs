//! Where files go, and in which form.

use std::path::{Path, PathBuf};

use anyhow::Result;

use crate::catalog::{EXPORTERS, ExporterEntry};
use crate::failure::Failure;
use crate::output;

/// Where files go, and in which form.
pub(super) struct Destination {
    /// The form.
    pub form: &'static ExporterEntry,
    place: Place,
}

enum Place {
    /// What the names of all files begin with.
    Stem(PathBuf),
    /// A folder, and the materials' own names.
    Folder(PathBuf),
}

impl Destination {
    /// What `--to` and `-o` mean for so many materials.
    pub fn new(to: Option<&str>, output: Option<&Path>, materials: usize) -> Result<Self> {
        let by_extension = output.and_then(ExporterEntry::of);
        let form = match (to, by_extension) {
            (Some(name), _) => ExporterEntry::named(name).ok_or_else(|| unknown(name))?,
            (None, Some(form)) => form,
            (None, None) => {
                return Err(Failure::Usage(format!("expected a form: --to {}", names())).into());
            }
        };
        let Some(output) = output else { return Ok(Self { form, place: Place::Folder(PathBuf::new()) }) };
        let means_a_folder = materials > 1 || output.is_dir() || output.to_string_lossy().ends_with('/');
        if means_a_folder {
            return Ok(Self { form, place: Place::Folder(output.to_owned()) });
        }
        let stem = match by_extension {
            Some(other) if other.name != form.name => {
                let (path, name, extension) = (output.display(), form.name, form.extension);
                return Err(Failure::Usage(format!("{path}: expected the extension .{extension} of {name}")).into());
            }
            Some(_) => output.with_extension(""),
            None => output.to_owned(),
        };
        Ok(Self { form, place: Place::Stem(stem) })
    }

    /// Makes the folder of several materials.
    pub fn make_folder(&self) -> Result<()> {
        match &self.place {
            Place::Folder(folder) if !folder.as_os_str().is_empty() => output::make_folder(folder),
            Place::Folder(_) | Place::Stem(_) => Ok(()),
        }
    }

    /// The stem of each material's files; names that a folder cannot hold twice are refused.
    pub fn stems<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<Vec<PathBuf>> {
        let folder = match &self.place {
            Place::Stem(stem) => return Ok(vec![stem.clone()]),
            Place::Folder(folder) => folder,
        };
        let mut stems: Vec<PathBuf> = Vec::new();
        for name in names {
            let stem = folder.join(name.replace(['/', '\\'], "_"));
            if stems.contains(&stem) {
                let stem = stem.display();
                return Err(
                    Failure::Usage(format!("{stem}: two materials would have this name: export one by one")).into()
                );
            }
            stems.push(stem);
        }
        Ok(stems)
    }

    /// All files of a stem, the manifest first.
    pub fn files(&self, stem: &Path) -> Vec<PathBuf> {
        std::iter::once(self.manifest(stem)).chain(self.form.paths(stem)).collect()
    }

    /// The manifest of a stem: other forms of the same stem keep theirs.
    pub fn manifest(&self, stem: &Path) -> PathBuf {
        let mut name = stem.as_os_str().to_owned();
        name.push(format!(".{}.manifest.json", self.form.extension));
        name.into()
    }
}

fn names() -> String {
    let names: Vec<&str> = EXPORTERS.iter().map(|entry| entry.name).collect();
    names.join("|")
}

fn unknown(name: &str) -> Failure {
    Failure::Usage(format!("--to: expected one of {}, found `{name}`: `nbrdf export --list` tells of them", names()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_says_the_form_and_may_be_left_out_where_it_is_said() {
        let of = |to, output: &str| Destination::new(to, Some(Path::new(output)), 1);
        let stem = |to, output: &str| of(to, output).unwrap().stems(["x"].into_iter()).unwrap().remove(0);
        assert_eq!(stem(None, "a.npz"), Path::new("a"));
        assert_eq!(stem(Some("npz"), "v1.chrome"), Path::new("v1.chrome"));
        assert!(of(Some("npz"), "a.bsdf").is_err() && of(None, "a").is_err() && of(Some("gif"), "a").is_err());
        let files = of(None, "a.bsdf").unwrap().files(Path::new("a"));
        assert_eq!(files, ["a.bsdf.manifest.json", "a.bsdf", "a.xml"].map(PathBuf::from));
    }

    #[test]
    fn materials_in_a_folder_have_names_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let to = Destination::new(Some("npz"), Some(folder.path()), 2).unwrap();
        let stems = to.stems(["rgl/paper", "chrome"].into_iter()).unwrap();
        assert_eq!(stems, ["rgl_paper", "chrome"].map(|name| folder.path().join(name)));
        assert!(to.stems(["rgl/paper", "rgl_paper"].into_iter()).is_err());
    }
}
