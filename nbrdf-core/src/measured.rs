//! Files of measurements, told apart by their names.

use std::path::Path;
use std::sync::Arc;

use crate::brdf::table::Lookup;
use crate::extensions::listed;
use crate::merl::{Merl, MerlError};
use crate::rgl::{RglError, RglTable};
use crate::sample_list::{SampleList, SampleListError};
use crate::{Brdf, Material, database};

/// Extensions of measurements that are read.
pub const EXTENSIONS: [&str; 4] = ["binary", "bsdf", "brdf", "csv"];

/// What was measured.
pub enum Measured {
    /// Everywhere: a MERL (`.binary`) or RGL (`.bsdf`) table, ready to be asked.
    Everywhere(Arc<dyn Brdf>),
    /// Everywhere, and of a material that changes when it is turned.
    Turning(Arc<dyn Brdf>),
    /// At some pairs of directions: a goniometer's text (`.brdf`) or values in `.csv`.
    Somewhere(SampleList),
}

/// A file that holds no measurement: which one, and why.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {problem}")]
pub struct MeasuredError {
    /// The file.
    pub file: String,
    /// What is wrong with it.
    pub problem: MeasuredProblem,
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum MeasuredProblem {
    /// No MERL table.
    #[error(transparent)]
    Merl(#[from] MerlError),
    /// No RGL material.
    #[error(transparent)]
    Rgl(#[from] RglError),
    /// No samples.
    #[error(transparent)]
    List(#[from] SampleListError),
    /// The name says nothing that is read here.
    #[error("expected a measurement ({}), found this name", listed(&EXTENSIONS))]
    Extension,
}

impl Measured {
    /// Reads a file in the form that its extension names.
    ///
    /// # Errors
    /// [`MeasuredError`] naming the file.
    pub fn load(path: &Path) -> Result<Self, MeasuredError> {
        let read = || -> Result<Self, MeasuredProblem> {
            Ok(match extension(path).as_str() {
                "binary" => Self::Everywhere(Arc::new(Merl::load(path)?.table(Lookup::Trilinear))),
                "bsdf" => match RglTable::load(path)? {
                    table if table.is_isotropic() => Self::Everywhere(Arc::new(table)),
                    table => Self::Turning(Arc::new(table)),
                },
                "brdf" | "csv" => Self::Somewhere(SampleList::load(path)?),
                _ => return Err(MeasuredProblem::Extension),
            })
        };
        read().map_err(|problem| MeasuredError { file: path.display().to_string(), problem })
    }
}

/// Whether a file's name is that of a measurement.
pub fn is_measured(path: &Path) -> bool {
    EXTENSIONS.contains(&extension(path).as_str())
}

/// The name that a measured material goes by.
pub fn name_of(path: &Path) -> String {
    let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    database::name_from_stem(&stem)
}

/// A measured table as a material.
pub fn material(path: &Path, table: Arc<dyn Brdf>) -> Material {
    Material::new(name_of(path), table)
}

fn extension(path: &Path) -> String {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_lowercase()
}
