//! Reports that are read again: bounded, of a known schema, and only such as their commands write.

use std::fmt::Display;
use std::path::Path;

use anyhow::Result;
use serde::de::DeserializeOwned;

use crate::failure::Failure;
use crate::input::check_file;

/// A report that a command reads again.
pub trait SavedReport: DeserializeOwned {
    /// Name of the command.
    const COMMAND: &'static str;
    /// Largest file that is read \[bytes\].
    const MAX_BYTES: u64;

    /// Of the report: 1.
    fn schema(&self) -> u32;

    /// What is wrong with it.
    ///
    /// # Errors
    /// What was found that the command does not write.
    fn check(&self) -> Result<(), String>;

    /// Reads a report.
    ///
    /// # Errors
    /// The file cannot be read, is too large, or is no such report.
    fn load(path: &Path) -> Result<Self> {
        check_file(path, &expected::<Self>())?;
        let name = path.display().to_string();
        let bytes = nbrdf_core::bounded::read(path, Self::MAX_BYTES).map_err(|error| invalid::<Self>(&name, &error))?;
        let too_large = || invalid::<Self>(&name, &format_args!("more than {} bytes", Self::MAX_BYTES));
        Self::parse(&name, &bytes.ok_or_else(too_large)?)
    }

    /// The report in bytes that came from `path`.
    ///
    /// # Errors
    /// It is no such report.
    fn parse(path: &str, bytes: &[u8]) -> Result<Self> {
        let saved: Self = serde_json::from_slice(bytes).map_err(|error| invalid::<Self>(path, &error))?;
        match saved.schema() {
            1 => saved.check().map_err(|found| invalid::<Self>(path, &found))?,
            schema => return Err(invalid::<Self>(path, &format_args!("schema {schema}")).into()),
        }
        Ok(saved)
    }
}

fn invalid<S: SavedReport>(path: &str, found: &dyn Display) -> Failure {
    Failure::InvalidFile(format!("{path}: expected {}, found {found}: make it again", expected::<S>()))
}

fn expected<S: SavedReport>() -> String {
    format!("a report of `nbrdf {} --json`", S::COMMAND)
}
