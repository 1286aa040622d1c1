//! The forms that a material is written in: one line here, and `nbrdf decode` and the app's window know it.

use std::any::Any;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use nbrdf_core::direction::turned;
use nbrdf_core::merl::Merl;
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::nbrdf::{ARRAYS, npy, safetensors};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Code, Directions, Material, Nbrdf, Rgb, atomic};

/// Every so many pairs of directions are turned.
const EVERY: usize = 256;
/// By how much they are turned \[rad\].
const ANGLES: [f32; 3] = [0.7, 1.6, 2.6];
/// Relative differences that are those of rounded directions.
const ROUNDING: f32 = 0.01;

/// What is written.
pub struct Subject<'a> {
    /// The material.
    pub material: &'a Material,
    /// Its code, where it has one.
    pub code: Option<&'a Code>,
}

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

/// A form in the list.
pub struct ExporterEntry {
    /// Name in lists, in sessions and in manifests.
    pub name: &'static str,
    /// Extension of its files, without the dot.
    pub extension: &'static str,
    /// One line for people.
    pub about: &'static str,
    /// What it needs.
    pub needs: Needs,
    /// What the names of its files end with, where it takes several.
    parts: &'static [&'static str],
    /// The bytes of each file; none where the material lacks what is needed.
    write: fn(&Subject<'_>) -> Option<Vec<Vec<u8>>>,
}

/// Every form, in the order of lists.
pub const EXPORTERS: &[ExporterEntry] = &[
    ExporterEntry {
        name: "npz",
        extension: "npz",
        about: "a network: six NumPy arrays in one archive",
        needs: Needs::Network,
        parts: &[],
        write: |subject| Some(vec![npy::write_npz(subject.network()?)]),
    },
    ExporterEntry {
        name: "safetensors",
        extension: "safetensors",
        about: "a network: one tensor",
        needs: Needs::Network,
        parts: &[],
        write: |subject| match subject.network() {
            Some(network) => Some(vec![safetensors::write_safetensors(network)]),
            None => Some(vec![safetensors::write_anisotropic(subject.turning()?)]),
        },
    },
    ExporterEntry {
        name: "npy",
        extension: "npy",
        about: "a network: six files, one NumPy array each",
        needs: Needs::Network,
        parts: &ARRAYS,
        write: |subject| Some(npy::write_npy(subject.network()?).into()),
    },
    ExporterEntry {
        name: "binary",
        extension: "binary",
        about: "a table of 90 × 90 × 180 cells as in the MERL database, 33 MB",
        needs: Needs::Reflectance,
        parts: &[],
        // Such a table cannot say how a material changes when it is turned.
        write: |subject| match subject.changes_when_turned() {
            true => None,
            false => Some(vec![Merl::tabulate(subject.material.brdf.as_ref()).to_bytes()]),
        },
    },
    ExporterEntry {
        name: "code",
        extension: "json",
        about: "its code, as `nbrdf encode` writes it",
        needs: Needs::Code,
        parts: &[],
        write: |subject| Some(vec![json(subject.code?)?.into_bytes()]),
    },
];

/// A code as its file holds it: one line.
pub fn json(code: &Code) -> Option<String> {
    Some(serde_json::to_string(code).ok()? + "\n")
}

impl Subject<'_> {
    /// The network behind the material, if it is one.
    pub fn network(&self) -> Option<&Nbrdf> {
        self.material.network.as_ref().or_else(|| self.behind())
    }

    /// The network of a material that changes when it is turned.
    fn turning(&self) -> Option<&AnisotropicNbrdf> {
        self.behind()
    }

    /// Whether the reflectance changes when the material is turned: a network that does may be mixed into others, so some
    /// pairs are asked.
    fn changes_when_turned(&self) -> bool {
        let brdf = self.material.brdf.as_ref();
        let at: Vec<Directions> = rus32k().iter().step_by(EVERY).copied().collect();
        let plain = evaluate(brdf, &at);
        let differs = |angle: f32| {
            let turned: Vec<Directions> = at.iter().map(|&at| turned(at, angle)).collect();
            let values = evaluate(brdf, &turned);
            Rgb::flat(&values).iter().zip(Rgb::flat(&plain)).any(|(a, b)| (a - b).abs() > ROUNDING * (a.max(*b) + 0.01))
        };
        self.turning().is_some() || ANGLES.into_iter().any(differs)
    }

    fn behind<T: 'static>(&self) -> Option<&T> {
        let brdf: &dyn Any = self.material.brdf.as_ref();
        brdf.downcast_ref()
    }
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
        let named = |end: &str| {
            let mut name = stem.as_os_str().to_owned();
            name.push(format!("{end}.{}", self.extension));
            PathBuf::from(name)
        };
        match self.parts {
            [] => vec![named("")],
            parts => parts.iter().map(|part| named(&format!("_{part}"))).collect(),
        }
    }

    /// The files and what they are to hold.
    ///
    /// # Errors
    /// That the material lacks what the form needs.
    pub fn files(&self, stem: &Path, subject: &Subject<'_>) -> Result<Vec<(PathBuf, Vec<u8>)>> {
        let lacks = || {
            let (name, form) = (&subject.material.name, self.name);
            match self.needs {
                Needs::Reflectance => format!("{name} changes when it is turned, which {form} cannot say"),
                Needs::Network => format!("{name} is no network, as {form} needs one: choose another form"),
                Needs::Code => format!("{name} has no code: `nbrdf encode` makes one of a material"),
            }
        };
        let bytes = (self.write)(subject).with_context(lacks)?;
        Ok(self.paths(stem).into_iter().zip(bytes).collect())
    }

    /// Writes the files, whole or not at all.
    ///
    /// # Errors
    /// As [`files`](Self::files), and what the file system reports.
    pub fn write(&self, path: &Path, subject: &Subject<'_>) -> Result<()> {
        let files = self.files(&path.with_extension(""), subject)?;
        let written = match files.as_slice() {
            [(path, bytes)] => atomic::write(path, bytes),
            set => atomic::write_together(set),
        };
        written.with_context(|| format!("{}: cannot be written", path.display()))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nbrdf_core::library::builtin;
    use nbrdf_core::path::mix::{Mix, Mixed};
    use nbrdf_core::{Brdf, Library};

    use super::*;

    #[test]
    fn every_form_of_a_network_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let material = builtin::shared().get("chrome").unwrap().material();
        let subject = Subject { material: &material, code: None };
        for entry in EXPORTERS.iter().filter(|entry| entry.needs == Needs::Network) {
            let path = folder.path().join(format!("v1.chrome.{}", entry.extension));
            ExporterEntry::of(&path).unwrap().write(&path, &subject).unwrap();
            let written = entry.paths(&folder.path().join("v1.chrome"));
            assert!(written.iter().all(|path| path.exists()), "{written:?}");
            let read = Library::load(&written[0]).map(Library::into_entries);
            if entry.parts.is_empty() {
                assert_eq!(read.unwrap()[0].network.weights(), subject.network().unwrap().weights());
            }
        }
    }

    #[test]
    fn what_lacks_a_code_is_told_so() {
        let material = builtin::shared().get("chrome").unwrap().material();
        let subject = Subject { material: &material, code: None };
        let error = ExporterEntry::named("code").unwrap().files(Path::new("a"), &subject).unwrap_err();
        assert!(error.to_string().contains("chrome has no code"), "{error}");
    }

    /// Brighter on one side of the brush than on the other.
    struct Brushed;

    impl Brdf for Brushed {
        fn eval(&self, at: Directions) -> Rgb {
            Rgb::splat(0.2 + 0.1 * (at.light + at.view).normalize().x)
        }
    }

    #[test]
    fn a_table_is_refused_where_something_that_turns_is_mixed_in() {
        for material in builtin::shared().materials() {
            let subject = Subject { material: &material, code: None };
            assert!(!subject.changes_when_turned(), "{}", material.name);
        }
        let plain = builtin::shared().get("white-fabric").unwrap().material().brdf;
        let parts: Vec<(f32, Arc<dyn Brdf>)> = vec![(0.75, plain), (0.25, Arc::new(Brushed))];
        let material = Material::new("mixed", Arc::new(Mixed::new(Mix::Linear, parts)));
        let subject = Subject { material: &material, code: None };
        let error = ExporterEntry::named("binary").unwrap().files(Path::new("a"), &subject).unwrap_err();
        assert!(error.to_string().contains("mixed changes when it is turned"), "{error}");
    }

    #[test]
    fn no_two_forms_share_a_name_or_an_extension() {
        for (place, entry) in EXPORTERS.iter().enumerate() {
            let others = &EXPORTERS[..place];
            assert!(others.iter().all(|other| other.name != entry.name && other.extension != entry.extension));
        }
    }
}
