//! Published networks in archives, folders and single files, each read or refused on its own.

use std::{
    collections::{BTreeMap, HashSet},
    path::Path,
};

use super::{Entry, LibraryError, MAX_NAME, folder, zip};
use crate::{
    database::name_from_stem,
    nbrdf::{
        ARRAYS, Nbrdf,
        file::{self, Form, ReadError, ReadProblem},
    },
};

/// Bytes read from one archive or folder.
pub(super) const MAX_TOTAL: u64 = 256 << 20;

/// A file found whose name is that of a network.
pub(super) struct Found {
    /// Folders within the source, with their last `/`.
    pub(super) parent: String,
    /// Name without folders.
    pub(super) file_name: String,
    /// Its bytes, or why there are none.
    pub(super) bytes: Result<Vec<u8>, ReadProblem>,
}

/// What became of one file, or one set of six.
#[derive(Debug)]
pub struct Scanned {
    /// Its name within the place scanned.
    pub source: String,
    /// The material, or why there is none.
    pub entry: Result<Entry, ReadError>,
}

/// Every network at a place, with the name of the file it is in: read, or why it cannot be. Ordered by database and
/// name, what cannot be read last. A folder of ours gives its materials.
///
/// # Errors
/// [`LibraryError`] where the place as a whole is not readable: absent, a damaged or hostile archive, no network at
/// all, or more files and bytes than a library has.
pub fn scan(path: &Path) -> Result<Vec<Scanned>, LibraryError> {
    if let Some(folder) = folder::of_library(path) {
        let library = folder::load(&folder)?;
        return Ok(library
            .into_entries()
            .into_iter()
            .map(|entry| Scanned { source: entry.source_file.clone(), entry: Ok(entry) })
            .collect());
    }
    let is_zip = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("zip"));
    if !path.is_dir() && !is_zip {
        return single(path).map(|found| vec![found]);
    }
    let found = if is_zip && !path.is_dir() { zip::files(path)? } else { folder::files(path)? };
    if found.is_empty() {
        return Err(LibraryError::Empty { path: path.display().to_string() });
    }
    Ok(sorted(&path.display().to_string(), found))
}

/// As [`scan`], in the bytes of an archive that came from `place`.
///
/// # Errors
/// As [`scan`].
pub fn scan_archive(place: &str, bytes: &[u8]) -> Result<Vec<Scanned>, LibraryError> {
    match zip::files_in(place, bytes)? {
        found if found.is_empty() => Err(LibraryError::Empty { path: place.to_owned() }),
        found => Ok(sorted(place, found)),
    }
}

/// What became of the files, ordered by database and name, what cannot be read last.
fn sorted(place: &str, found: Vec<Found>) -> Vec<Scanned> {
    let mut networks = networks(place, found);
    networks.sort_by_cached_key(|Scanned { source, entry }| {
        (entry.is_err(), entry.as_ref().ok().map(|entry| (entry.database, entry.name.clone())), source.clone())
    });
    networks
}

fn single(path: &Path) -> Result<Scanned, LibraryError> {
    path.metadata().map_err(LibraryError::io(path))?;
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let network = file::read(path);
    let stem = Form::of(&name).map_or(name.as_str(), |(_, stem)| stem).to_owned();
    let entry = network.and_then(|network| entry(&stem, &name, network).map_err(|p| p.of(path.display().to_string())));
    Ok(Scanned { source: name, entry })
}

/// Parses each file, and each set of six `.npy`; of two with the same material name the second is refused.
fn networks(place: &str, found: Vec<Found>) -> Vec<Scanned> {
    let mut parsed: Vec<(String, String, Result<Nbrdf, ReadProblem>)> = Vec::new();
    let mut sets: BTreeMap<(String, String), file::SetOfSix> = BTreeMap::new();
    for Found { parent, file_name, bytes } in found {
        match Form::of(&file_name) {
            Some((Form::Npy(array), stem)) => {
                let set = sets.entry((parent, stem.to_owned())).or_default();
                if let Some(place) = set.get_mut(array) {
                    *place = Some(bytes);
                }
            }
            Some((form, stem)) => {
                let network = bytes.and_then(|bytes| file::parse(form, &bytes));
                parsed.push((format!("{parent}{file_name}"), stem.to_owned(), network));
            }
            None => {}
        }
    }
    for ((parent, stem), set) in sets {
        parsed.push((format!("{parent}{stem}_{}.npy", ARRAYS[0]), stem, file::set(set)));
    }
    let mut names = HashSet::new();
    let mut checked = |source: &str, stem: &str, network: Result<Nbrdf, ReadProblem>| {
        let entry = entry(stem, source, network?)?;
        if names.insert(entry.name.clone()) { Ok(entry) } else { Err(ReadProblem::Duplicate(entry.name)) }
    };
    parsed
        .into_iter()
        .map(|(source, stem, network)| {
            let entry = checked(&source, &stem, network).map_err(|problem| problem.of(format!("{place}: {source}")));
            Scanned { source, entry }
        })
        .collect()
}

fn entry(stem: &str, source: &str, network: Nbrdf) -> Result<Entry, ReadProblem> {
    let name = name_from_stem(stem);
    if is_name(&name) { Ok(Entry::new(name, source, network)) } else { Err(ReadProblem::Name(name)) }
}

/// Whether every name can name a material, and none is there twice.
pub(super) fn check_names(entries: &[Entry]) -> Result<(), ReadError> {
    let mut names = HashSet::new();
    for entry in entries {
        if !is_name(&entry.name) {
            return Err(ReadProblem::Name(entry.name.clone()).of(&entry.source_file));
        }
        if !names.insert(&entry.name) {
            return Err(ReadProblem::Duplicate(entry.name.clone()).of(&entry.source_file));
        }
    }
    Ok(())
}

/// Whether this can name a material: 1 to [`MAX_NAME`] bytes, no control characters, no leading `@`.
pub fn is_name(name: &str) -> bool {
    (1..=MAX_NAME).contains(&name.len()) && !name.starts_with('@') && !name.chars().any(char::is_control)
}
