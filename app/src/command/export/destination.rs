//! Where files go, and in which form.

use std::path::{Path, PathBuf};

use anyhow::Result;

use crate::catalog::{EXPORTERS, ExporterEntry};
use crate::exported::FileSet;
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
        let names = || EXPORTERS.iter().map(|entry| entry.name).collect::<Vec<_>>().join("|");
        let form = match to {
            Some(name) => ExporterEntry::named(name),
            None => output.and_then(ExporterEntry::of),
        };
        let form = form.ok_or_else(|| Failure::Usage(format!("expected a form: --to {}", names())))?;
        let place = output.map_or(Ok(Place::Folder(PathBuf::new())), |output| Place::new(output, form, materials))?;
        Ok(Self { form, place })
    }

    /// Makes the folder of several materials.
    pub fn make_folder(&self) -> Result<()> {
        match &self.place {
            Place::Folder(folder) if !folder.as_os_str().is_empty() => output::make_folder(folder),
            Place::Folder(_) | Place::Stem(_) => Ok(()),
        }
    }

    /// Each material's files; names that a folder cannot hold twice are refused.
    pub fn sets<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<Vec<FileSet>> {
        let is_named = matches!(self.place, Place::Stem(_));
        let set = |stem: PathBuf| FileSet { form: self.form, stem, is_named };
        let folder = match &self.place {
            Place::Stem(stem) => return Ok(vec![set(stem.clone())]),
            Place::Folder(folder) => folder,
        };
        let mut sets: Vec<FileSet> = Vec::new();
        for name in names {
            let stem = folder.join(name.replace(['/', '\\'], "_"));
            if sets.iter().any(|known| known.stem == stem) {
                let stem = stem.display();
                return Err(
                    Failure::Usage(format!("{stem}: two materials would have this name: export one by one")).into()
                );
            }
            sets.push(set(stem));
        }
        Ok(sets)
    }
}

impl Place {
    /// What a path means; the extension of another form, or of one file for several materials, is a slip.
    fn new(output: &Path, form: &ExporterEntry, materials: usize) -> Result<Self> {
        let path = output.display();
        let is_folder = output.is_dir() || output.to_string_lossy().ends_with('/');
        match output.extension() {
            _ if is_folder => Ok(Self::Folder(output.to_owned())),
            None if materials > 1 => Ok(Self::Folder(output.to_owned())),
            Some(_) if materials > 1 => {
                let folder = output.with_extension("");
                let said = format!("{path}: expected a folder for {materials} materials, found the name of one file");
                let (name, folder) = (form.name, folder.display());
                Err(Failure::Usage(format!("{said}: name a folder, as in --to {name} -o {folder}/")).into())
            }
            Some(extension) if extension == form.extension => Ok(Self::Stem(output.with_extension(""))),
            None => Ok(Self::Stem(output.to_owned())),
            Some(extension) => {
                let (name, own, found) = (form.name, form.extension, extension.display());
                let said = format!("{path}: expected the extension .{own} of {name} or none, found .{found}");
                Err(Failure::Usage(format!("{said}: a name with a dot needs .{own} at its end")).into())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_says_the_form_and_may_be_left_out_where_it_is_said() {
        let of = |to, output: &str| Destination::new(to, Some(Path::new(output)), 1);
        let stem = |to, output: &str| of(to, output).unwrap().sets(["x"].into_iter()).unwrap().remove(0).stem;
        assert_eq!(stem(None, "a.npz"), Path::new("a"));
        assert_eq!(stem(Some("npz"), "v1.chrome.npz"), Path::new("v1.chrome"));
        assert_eq!(stem(Some("principled"), "a.py"), Path::new("a"));
        for (to, output) in [
            (Some("npz"), "a.bsdf"),
            (Some("gltf"), "a.glb"),
            (None, "a"),
            (Some("gif"), "a"),
            (Some("npz"), "v1.chrome"),
        ] {
            assert!(of(to, output).is_err(), "{output}");
        }
    }

    #[test]
    fn materials_in_a_folder_have_names_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let to = Destination::new(Some("npz"), Some(folder.path()), 2).unwrap();
        let sets = to.sets(["rgl/paper", "chrome"].into_iter()).unwrap();
        let stems: Vec<_> = sets.into_iter().map(|set| set.stem).collect();
        assert_eq!(stems, ["rgl_paper", "chrome"].map(|name| folder.path().join(name)));
        assert!(to.sets(["rgl/paper", "rgl_paper"].into_iter()).is_err());
    }

    #[test]
    fn several_materials_go_into_no_file() {
        let of = |output: &str| Destination::new(Some("npz"), Some(Path::new(output)), 2);
        assert!(of("two").is_ok() && of("two.npz/").is_ok());
        assert!(of("two.npz").is_err() && of("two.glb").is_err());
    }
}
