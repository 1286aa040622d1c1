//! Networks in files, told apart by their names: `.h5`, `.npz`, `.safetensors`, and sets of six `.npy`.

mod form;

use std::{
    fs,
    io::{self, Read},
    path::{Path, PathBuf},
};

use super::{
    ARRAYS, Nbrdf,
    anisotropic::AnisotropicNbrdf,
    keras::{self, KerasError},
    npy::{self, NpyError},
    safetensors::{self, TensorError},
};
use crate::{atomic, extensions::listed};

pub use form::Form;

/// Largest file of one network that is read \[bytes\]; a published one has 18,736.
pub const MAX_FILE: u64 = 4 << 20;

/// A file that is no readable network: which one, and why.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {problem}")]
pub struct ReadError {
    /// The file, or the archive and the name within.
    pub file: String,
    /// What is wrong with it.
    pub problem: ReadProblem,
}

/// What is wrong with a file: what was expected, what was found, what to do.
#[derive(Debug, thiserror::Error)]
pub enum ReadProblem {
    /// The file system says no.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// More bytes than a network needs, whatever the headers claim.
    #[error("more than {MAX_FILE} bytes, expected a network of some 20 kB: is it the right file?")]
    TooLarge,
    /// The name says nothing that is read here.
    #[error("expected the extension {} (six .npy are NAME_fc1.npy ... NAME_b3.npy), found this name", listed(&Form::EXTENSIONS))]
    UnknownForm,
    /// An archive's entry cannot be unpacked.
    #[error("cannot be unpacked ({0}): unpack it with another program, or fetch it again")]
    Entry(String),
    /// Two files claim the same material.
    #[error("material `{0}` is there twice: remove or rename one of the files")]
    Duplicate(String),
    /// The file's name makes no material's name.
    #[error("`{0}` cannot name a material (1 to 128 characters, no control characters, no leading `@`): rename it")]
    Name(String),
    /// A Keras file without a network.
    #[error(transparent)]
    Keras(#[from] KerasError),
    /// NumPy arrays without a network.
    #[error(transparent)]
    Npy(#[from] NpyError),
    /// A safetensors file without a network.
    #[error(transparent)]
    Safetensors(#[from] TensorError),
}

impl ReadProblem {
    /// The same, with the file it is about.
    pub fn of(self, file: impl Into<String>) -> ReadError {
        ReadError { file: file.into(), problem: self }
    }
}

/// Reads the network in a file; of a set of six `.npy`, name any one.
///
/// # Errors
/// [`ReadError`] naming the file: not there, larger than [`MAX_FILE`], of a form not known, or not a network.
pub fn read(path: &Path) -> Result<Nbrdf, ReadError> {
    let of = |problem: ReadProblem| problem.of(path.display().to_string());
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let (form, stem) = Form::of(name).ok_or(ReadProblem::UnknownForm).map_err(of)?;
    match form {
        Form::Npy(_) => {
            // Not while somebody replaces them.
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            let _held = atomic::hold_to_read(folder);
            let files = ARRAYS.map(|array| {
                let sibling = path.with_file_name(format!("{stem}_{array}.npy"));
                sibling.exists().then(|| bytes(&sibling))
            });
            set(files).map_err(of)
        }
        single => bytes(path).and_then(|bytes| parse(single, &bytes)).map_err(of),
    }
}

/// Writes a network in the form of the path's extension: `.npz`, `.safetensors`, or `.npy` (`a/chrome.npy` becomes
/// the six files `a/chrome_fc1.npy` ... `a/chrome_b3.npy`).
///
/// # Errors
/// [`io::ErrorKind::InvalidInput`] for another extension, else what the file system reports. No file is left half
/// written.
pub fn write(path: &Path, network: &Nbrdf) -> io::Result<()> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("npz") => atomic::write(path, &npy::write_npz(network)),
        Some("safetensors") => atomic::write(path, &safetensors::write_safetensors(network)),
        Some("npy") => {
            let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
            let file = |array: &str| -> PathBuf { path.with_file_name(format!("{stem}_{array}.npy")) };
            let files = ARRAYS.iter().zip(npy::write_npy(network)).map(|(array, bytes)| (file(array), bytes));
            atomic::write_together(&files.collect::<Vec<_>>())
        }
        _ => {
            let what = format!("{}: expected the extension .npz, .safetensors or .npy", path.display());
            Err(io::Error::new(io::ErrorKind::InvalidInput, what))
        }
    }
}

/// The network of an anisotropic material in a `.safetensors` file; none where the file is of another form, or holds
/// something else.
///
/// # Errors
/// As [`read`].
pub fn read_anisotropic(path: &Path) -> Result<Option<AnisotropicNbrdf>, ReadError> {
    let of = |problem: ReadProblem| problem.of(path.display().to_string());
    let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    match Form::of(name) {
        Some((Form::Safetensors, _)) => {
            let bytes = bytes(path).map_err(of)?;
            safetensors::read_anisotropic(&bytes).map_err(|problem| of(problem.into()))
        }
        _ => Ok(None),
    }
}

/// Writes the network of an anisotropic material: `.safetensors` alone, for the other forms cannot say what it is.
///
/// # Errors
/// [`io::ErrorKind::InvalidInput`] for another extension, else what the file system reports.
pub fn write_anisotropic(path: &Path, network: &AnisotropicNbrdf) -> io::Result<()> {
    if path.extension().is_none_or(|extension| extension != "safetensors") {
        let what = format!("{}: expected the extension .safetensors", path.display());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
    }
    atomic::write(path, &safetensors::write_anisotropic(network))
}

/// The network in the bytes of one file.
pub(crate) fn parse(form: Form, bytes: &[u8]) -> Result<Nbrdf, ReadProblem> {
    Ok(match form {
        Form::Keras => keras::read_keras(bytes)?,
        Form::Npz => npy::read_npz(bytes)?,
        Form::Safetensors => safetensors::read_safetensors(bytes)?,
        Form::Npy(_) => return Err(ReadProblem::UnknownForm),
    })
}

/// Six `.npy` files in the order of [`ARRAYS`]; none for a file that is not there.
pub(crate) type SetOfSix = [Option<Result<Vec<u8>, ReadProblem>>; 6];

/// The network in a set of six files.
pub(crate) fn set(files: SetOfSix) -> Result<Nbrdf, ReadProblem> {
    let absent = ARRAYS.iter().zip(&files).filter(|(_, file)| file.is_none());
    let missing: Vec<String> = absent.map(|(array, _)| (*array).to_owned()).collect();
    if !missing.is_empty() {
        return Err(NpyError::Missing { missing }.into());
    }
    let present: Vec<Vec<u8>> = files.into_iter().flatten().collect::<Result<_, _>>()?;
    match present.as_slice() {
        [a, b, c, d, e, f] => Ok(npy::read_npy([a, b, c, d, e, f])?),
        _ => Err(ReadProblem::UnknownForm),
    }
}

/// All bytes of a file of at most [`MAX_FILE`].
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, ReadProblem> {
    limited(fs::File::open(path)?)
}

/// All bytes of a reader, as long as they are at most [`MAX_FILE`].
pub(crate) fn limited(reader: impl Read) -> Result<Vec<u8>, ReadProblem> {
    let mut bytes = Vec::new();
    reader.take(MAX_FILE + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE { Err(ReadProblem::TooLarge) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Nbrdf {
        Nbrdf::published((0..675).map(|i| i as f32).collect()).unwrap()
    }

    #[test]
    fn every_form_that_is_written_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        for (written, named) in [("a.npz", "a.npz"), ("a.safetensors", "a.safetensors"), ("a.npy", "a_b2.npy")] {
            write(&folder.path().join(written), &sample()).unwrap();
            assert_eq!(read(&folder.path().join(named)).unwrap(), sample());
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 8);
    }

    #[test]
    fn an_incomplete_set_names_what_is_missing() {
        let folder = tempfile::tempdir().unwrap();
        write(&folder.path().join("a.npy"), &sample()).unwrap();
        fs::remove_file(folder.path().join("a_fc2.npy")).unwrap();
        let error = read(&folder.path().join("a_fc1.npy")).unwrap_err().to_string();
        assert!(error.contains("a_fc1.npy: arrays [fc2] are missing"), "{error}");
    }

    #[test]
    fn errors_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bad.h5");
        fs::write(&path, b"not hdf5").unwrap();
        assert!(read(&path).unwrap_err().to_string().contains("bad.h5: not an HDF5 file"));
        fs::File::create(&path).unwrap().set_len(MAX_FILE + 1).unwrap();
        assert!(matches!(read(&path).unwrap_err().problem, ReadProblem::TooLarge));
        assert!(matches!(read(&folder.path().join("none.npz")).unwrap_err().problem, ReadProblem::Io(_)));
        assert!(matches!(read(&folder.path().join("model.json")).unwrap_err().problem, ReadProblem::UnknownForm));
        assert!(write(&folder.path().join("a.h5"), &sample()).is_err());
    }
}
