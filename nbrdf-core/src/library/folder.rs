//! Folders: our own form, and loose files of published networks.

use std::{
    fs,
    io::{self, Read},
    path::{Path, PathBuf},
};

use super::{
    Library, LibraryError, MAX_ENTRIES, manifest,
    scan::{Found, MAX_TOTAL},
};
use crate::{
    atomic,
    nbrdf::file::{self, Form},
};

const TENSORS: &str = "library.safetensors";
const MANIFEST: &str = "manifest.json";
/// The files of a library.
pub(super) const FILES: [&str; 2] = [MANIFEST, TENSORS];
/// The manifest while a save is under way.
const STAGED: &str = ".manifest.json.new";
/// Largest of the two files that is read \[bytes\].
const MAX_BYTES: u64 = 64 << 20;

/// The folder of a library of ours, if the path is one, or one of its two files.
pub(super) fn of_library(path: &Path) -> Option<PathBuf> {
    let ours = |name: &std::ffi::OsStr| FILES.iter().any(|own| name == *own);
    if path.is_dir() {
        return FILES.iter().any(|name| path.join(name).is_file()).then(|| path.to_owned());
    }
    (path.is_file() && path.file_name().is_some_and(ours)).then(|| path.with_file_name(""))
}

pub(super) fn load(folder: &Path) -> Result<Library, LibraryError> {
    let read = |name: &str| -> Result<Vec<u8>, LibraryError> {
        let path = folder.join(name);
        let mut bytes = Vec::new();
        let file = fs::File::open(&path).map_err(LibraryError::io(&path))?;
        file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(LibraryError::io(&path))?;
        if bytes.len() as u64 > MAX_BYTES {
            return Err(LibraryError::TooLarge { path: path.display().to_string(), limit: MAX_BYTES });
        }
        Ok(bytes)
    };
    let _held = atomic::hold_to_read(folder);
    let tensors = read(TENSORS)?;
    let whole = read(MANIFEST).and_then(|manifest| Library::from_bytes(&tensors, &manifest));
    // Where a save was stopped between its two renames, the manifest that goes with the tensors is the staged one.
    whole.or_else(|error| match read(STAGED).and_then(|manifest| Library::from_bytes(&tensors, &manifest)) {
        Ok(library) => Ok(library),
        Err(_) => Err(error),
    })
}

/// Refuses a folder in which a save would replace something else than a library.
pub(super) fn check(folder: &Path) -> Result<(), LibraryError> {
    let there: Vec<&str> = FILES.into_iter().filter(|name| folder.join(name).symlink_metadata().is_ok()).collect();
    if there.is_empty() {
        return Ok(());
    }
    load(folder).map(drop).map_err(|error| {
        let found = match there.as_slice() {
            [alone] => format!("{alone} alone"),
            _ => error.to_string(),
        };
        LibraryError::Foreign { path: folder.display().to_string(), found }
    })
}

/// Both files are complete under temporary names before either is renamed. Should the second rename fail, the first
/// is taken back; should the process be stopped between the two, the staged manifest is read.
pub(super) fn save(library: &Library, folder: &Path) -> Result<(), LibraryError> {
    let (tensors, manifest) = manifest::to_bytes(library)?;
    fs::create_dir_all(folder).map_err(LibraryError::io(folder))?;
    let _held = atomic::hold(folder);
    let tensors_path = folder.join(TENSORS);
    let before = match fs::read(&tensors_path) {
        Ok(bytes) => Some(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(LibraryError::io(&tensors_path)(error)),
    };
    let (staged_path, manifest_path) = (folder.join(STAGED), folder.join(MANIFEST));
    atomic::write(&staged_path, &manifest).map_err(LibraryError::io(&staged_path))?;
    let renamed = match atomic::write(&tensors_path, &tensors) {
        Ok(()) => fs::rename(&staged_path, &manifest_path).map_err(|failed| {
            let restored = match before {
                Some(bytes) => atomic::write(&tensors_path, &bytes),
                None => fs::remove_file(&tensors_path),
            };
            LibraryError::io(&manifest_path)(restored.err().unwrap_or(failed))
        }),
        Err(failed) => Err(LibraryError::io(&tensors_path)(failed)),
    };
    if renamed.is_err() {
        // The failure itself is what to report, not what is left of the attempt.
        let _ = fs::remove_file(&staged_path);
    }
    renamed
}

/// The files of networks in a folder, not below it. Everything else is passed over without being read.
pub(super) fn files(folder: &Path) -> Result<Vec<Found>, LibraryError> {
    let too_large = || LibraryError::TooLarge { path: folder.display().to_string(), limit: MAX_TOTAL };
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(LibraryError::io(folder))? {
        let name = entry.map_err(LibraryError::io(folder))?.file_name();
        names.extend(name.into_string().ok().filter(|name| Form::of(name).is_some()));
        if names.len() > MAX_ENTRIES {
            return Err(too_large());
        }
    }
    names.sort();
    let mut found = Vec::new();
    let mut total = 0;
    for file_name in names {
        let bytes = file::bytes(&folder.join(&file_name));
        total += bytes.as_ref().map_or(0, Vec::len) as u64;
        if total > MAX_TOTAL {
            return Err(too_large());
        }
        found.push(Found { parent: String::new(), file_name, bytes });
    }
    Ok(found)
}
