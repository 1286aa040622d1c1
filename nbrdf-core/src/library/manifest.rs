//! `manifest.json`: what each material of a library is, from what, by which command, with which seed and error.

use std::collections::{BTreeMap, HashSet};

use serde::{Deserialize, Serialize};

use super::{Entry, Library, LibraryError, MAX_ENTRIES};
use crate::hash::sha256;
use crate::{
    Database, Nbrdf,
    nbrdf::{PUBLISHED_HIDDEN, safetensors},
};

/// Name of the tensor that holds the shared initial network.
const SHARED_START: &str = "@shared_start";

/// What a library was made from, and how.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// One line that says what the library is.
    pub title: String,
    /// The command that made it, for one who wants to make it again; empty for one read from published files.
    pub command: String,
    /// The seed it was made with.
    pub seed: u64,
    /// Published files it was made from.
    pub derived_from: Vec<Source>,
}

/// A published file a library was made from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Its name.
    pub file: String,
    /// Its SHA-256 (see [`sha256`]).
    pub sha256: String,
    /// Who published it.
    pub source: String,
    /// On which terms.
    pub terms: String,
}

#[derive(Serialize, Deserialize)]
struct Manifest {
    schema: u64,
    #[serde(flatten)]
    provenance: Provenance,
    shared_start: bool,
    /// Ties the two files together, so that half of an interrupted save is told from a whole one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tensors_sha256: Option<String>,
    materials: Vec<Row>,
}

#[derive(Serialize, Deserialize)]
struct Row {
    name: String,
    database: Database,
    held_out: bool,
    source_file: String,
    #[serde(default)]
    error: BTreeMap<String, f64>,
    /// Hidden widths, where they are not those of the tensor file's metadata.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    hidden: Option<[usize; 2]>,
}

/// The bytes of `library.safetensors` and `manifest.json`; the same library gives the same bytes.
pub(super) fn to_bytes(library: &Library) -> Result<(Vec<u8>, Vec<u8>), LibraryError> {
    let start = library.shared_start.as_ref().map(|network| (SHARED_START, network));
    let networks = library.entries.iter().map(|entry| (entry.name.as_str(), &entry.network)).chain(start);
    let hidden = library.shared_start.as_ref().or(library.entries.first().map(|entry| &entry.network));
    let hidden = hidden.map_or(PUBLISHED_HIDDEN, Nbrdf::hidden);
    let tensors = safetensors::write_many(networks.map(|(name, network)| (name, network.weights())), hidden);
    let manifest = Manifest {
        schema: 1,
        provenance: library.provenance.clone(),
        shared_start: library.shared_start.is_some(),
        tensors_sha256: Some(sha256(&tensors)),
        materials: library.entries.iter().map(|entry| row(entry, hidden)).collect::<Result<_, _>>()?,
    };
    let mut json = serde_json::to_vec_pretty(&manifest).map_err(|error| LibraryError::Manifest(error.to_string()))?;
    json.push(b'\n');
    Ok((tensors, json))
}

fn row(entry: &Entry, hidden: [usize; 2]) -> Result<Row, LibraryError> {
    if let Some((key, &value)) = entry.error.iter().find(|(_, value)| !value.is_finite()) {
        return Err(LibraryError::NotFinite { name: entry.name.clone(), key: key.clone(), value });
    }
    Ok(Row {
        name: entry.name.clone(),
        database: entry.database,
        held_out: entry.held_out,
        source_file: entry.source_file.clone(),
        error: entry.error.clone(),
        hidden: Some(entry.network.hidden()).filter(|own| *own != hidden),
    })
}

pub(super) fn from_bytes(tensors: &[u8], manifest: &[u8]) -> Result<Library, LibraryError> {
    let value: serde_json::Value =
        serde_json::from_slice(manifest).map_err(|error| LibraryError::Manifest(error.to_string()))?;
    if value.get("schema").and_then(serde_json::Value::as_u64) != Some(1) {
        let schema = value.get("schema").map_or("none".to_owned(), ToString::to_string);
        return Err(LibraryError::Manifest(format!("schema {schema}: a newer nbrdf may read it")));
    }
    let manifest: Manifest =
        serde_json::from_value(value).map_err(|error| LibraryError::Manifest(error.to_string()))?;
    if manifest.materials.len() > MAX_ENTRIES {
        return Err(LibraryError::Manifest(format!("{} materials", manifest.materials.len())));
    }
    if manifest.tensors_sha256.as_ref().is_some_and(|sum| *sum != sha256(tensors)) {
        return Err(LibraryError::Mismatch("the checksum differs".to_owned()));
    }
    let (hidden, tensors) = safetensors::open(tensors)?;
    let read = |name: &str, hidden| -> Result<Nbrdf, LibraryError> {
        let tensor = tensors.tensor(name).map_err(|_| LibraryError::Mismatch(format!("no tensor `{name}`")))?;
        Ok(safetensors::network(name, &tensor, hidden)?)
    };
    let mut known: HashSet<String> = manifest.materials.iter().map(|row| row.name.clone()).collect();
    let mut entries = Vec::with_capacity(manifest.materials.len());
    for Row { name, database, held_out, source_file, error, hidden: own } in manifest.materials {
        let network = read(&name, own.unwrap_or(hidden))?;
        entries.push(Entry { name, database, held_out, source_file, error, network });
    }
    let shared_start = manifest.shared_start.then(|| read(SHARED_START, hidden)).transpose()?;
    known.extend(shared_start.is_some().then(|| SHARED_START.to_owned()));
    if let Some(surplus) = tensors.names().into_iter().find(|name| !known.contains(*name)) {
        return Err(LibraryError::Mismatch(format!("tensor `{surplus}` is not in the manifest")));
    }
    Library::new(manifest.provenance, shared_start, entries)
}
