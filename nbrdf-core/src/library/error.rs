//! What can be wrong with a library as a whole.

use std::{io, path::Path};

use super::{MAX_ENTRIES, folder::FILES};
use crate::{
    extensions::listed,
    nbrdf::{
        file::{Form, ReadError},
        safetensors::TensorError,
    },
};

/// Why a library cannot be opened or written.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// The file system says no.
    #[error("{path}: {problem}")]
    Io {
        /// The file or folder.
        path: String,
        /// What the file system says.
        problem: io::Error,
    },
    /// A zip archive that cannot be trusted or followed.
    #[error("{path}: not a readable zip archive ({found}): fetch it again, or unpack it and name the folder")]
    Archive {
        /// The archive.
        path: String,
        /// What is wrong.
        found: String,
    },
    /// More files or bytes than a library has.
    #[error("{path}: expected at most {MAX_ENTRIES} files and {limit} bytes in all, found more: name a smaller source")]
    TooLarge {
        /// The archive or folder.
        path: String,
        /// Bytes allowed.
        limit: u64,
    },
    /// Nothing to read there.
    #[error("{path}: expected networks ({}), found none: name a folder or archive of them", listed(&Form::EXTENSIONS))]
    Empty {
        /// The archive or folder.
        path: String,
    },
    /// One file is no readable network.
    #[error(transparent)]
    Entry(#[from] ReadError),
    /// `library.safetensors` is damaged.
    #[error("library.safetensors: {0}")]
    Tensors(#[from] TensorError),
    /// `manifest.json` is no manifest.
    #[error("manifest.json: expected a library's manifest with \"schema\": 1, found {0}")]
    Manifest(String),
    /// The two files do not belong together.
    #[error("manifest.json and library.safetensors do not belong together ({0}): make the library again")]
    Mismatch(String),
    /// Files that a library would be written over, and that are none of its own.
    #[error(
        "{path}: expected no {}, or both of a library, found {found}: name another folder, or move them away",
        FILES.join(" and no ")
    )]
    Foreign {
        /// The folder.
        path: String,
        /// What is there instead.
        found: String,
    },
    /// A number that JSON cannot hold.
    #[error("error `{key}` of material `{name}` is {value}, expected a finite number")]
    NotFinite {
        /// The material.
        name: String,
        /// Key in its error map.
        key: String,
        /// The number.
        value: f64,
    },
}

impl LibraryError {
    /// For `map_err`: what the file system said, and about what.
    pub(super) fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.display().to_string();
        |problem| Self::Io { path, problem }
    }
}
