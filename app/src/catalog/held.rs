//! A basis that was read from a file: for the representation it is of, or told that nothing asked for it.

use std::sync::atomic::{AtomicBool, Ordering};

use nbrdf_core::representation::basis::BasisFile;

/// The file, and whether it was asked for.
pub(super) struct Held {
    pub path: String,
    pub file: BasisFile,
    is_used: AtomicBool,
}

impl Held {
    pub(super) const fn new(path: String, file: BasisFile) -> Self {
        Self { path, file, is_used: AtomicBool::new(false) }
    }

    /// The file, for whoever asks for a basis of its name.
    pub(super) fn of(&self, name: &str) -> Option<&BasisFile> {
        let found = (self.file.name() == name).then_some(&self.file);
        self.is_used.fetch_or(found.is_some(), Ordering::Relaxed);
        found
    }

    pub(super) fn is_used(&self) -> bool {
        self.is_used.load(Ordering::Relaxed)
    }
}
