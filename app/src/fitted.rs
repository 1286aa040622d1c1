//! What a fit gives: a network, and what it reads.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, Result};
use nbrdf_core::library::builtin;
use nbrdf_core::measured::Measured;
use nbrdf_core::metric::{albedo_max, albedo_max_around};
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::nbrdf::file;
use nbrdf_core::nbrdf::fit::{FitOptions, fit, fit_anisotropic, fit_list, fit_list_anisotropic, random_hidden};
use nbrdf_core::nbrdf::safetensors::{self, TensorError};
use nbrdf_core::sample_list::SampleList;
use nbrdf_core::{Brdf, Material, Nbrdf};

/// Why there is nothing, where nobody has stopped the fit.
pub const DIVERGED: &str = "the fit has diverged: are all measured values finite?";

/// A network of either kind.
pub enum Fitted {
    /// Of a material that is the same however it is turned.
    Isotropic(Nbrdf),
    /// Of one that is not.
    Turning(AnisotropicNbrdf),
}

impl Fitted {
    /// Fits to a measurement; none if it is cancelled or diverges.
    pub fn to(
        measured: &Measured,
        turns: bool,
        start: &Nbrdf,
        options: FitOptions,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Self> {
        match measured {
            Measured::Somewhere(list) => Self::to_list(list, turns, start, options, cancelled),
            Measured::Everywhere(table) | Measured::Turning(table) => match turns {
                true => fit_anisotropic(start, table.as_ref(), options, cancelled).map(Self::Turning),
                false => fit(start, table.as_ref(), options, cancelled).map(Self::Isotropic),
            },
        }
    }

    /// The same to samples.
    pub fn to_list(
        list: &SampleList,
        turns: bool,
        start: &Nbrdf,
        options: FitOptions,
        cancelled: &dyn Fn() -> bool,
    ) -> Option<Self> {
        match turns {
            true => fit_list_anisotropic(start, list, options, cancelled).map(Self::Turning),
            false => fit_list(start, list, options, cancelled).map(Self::Isotropic),
        }
    }

    /// Its reflectance.
    pub fn brdf(&self) -> &dyn Brdf {
        match self {
            Self::Isotropic(network) => network,
            Self::Turning(network) => network,
        }
    }

    /// Largest albedo: of viewers all around where that matters.
    pub fn albedo_max(&self) -> f64 {
        match self {
            Self::Isotropic(network) => albedo_max(network),
            Self::Turning(network) => albedo_max_around(network),
        }
    }

    /// Hidden widths.
    pub const fn hidden(&self) -> [usize; 2] {
        match self {
            Self::Isotropic(network) => network.hidden(),
            Self::Turning(network) => network.hidden(),
        }
    }

    /// Flattened weights.
    pub fn weights(&self) -> &[f32] {
        match self {
            Self::Isotropic(network) => network.weights(),
            Self::Turning(network) => network.weights(),
        }
    }

    /// Its bytes as a `.safetensors` file.
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            Self::Isotropic(network) => safetensors::write_safetensors(network),
            Self::Turning(network) => safetensors::write_anisotropic(network),
        }
    }

    /// What such bytes hold.
    ///
    /// # Errors
    /// If they are none of a network.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, TensorError> {
        match safetensors::read_anisotropic(bytes)? {
            Some(network) => Ok(Self::Turning(network)),
            None => safetensors::read_safetensors(bytes).map(Self::Isotropic),
        }
    }

    /// A material of this name.
    pub fn into_material(self, name: String) -> Material {
        match self {
            Self::Isotropic(network) => Material::from_network(name, network),
            Self::Turning(network) => Material::new(name, Arc::new(network)),
        }
    }

    /// Writes it in the form of the path's extension.
    pub fn write(&self, path: &Path) -> Result<()> {
        let written = match self {
            Self::Isotropic(network) => file::write(path, network),
            Self::Turning(network) => file::write_anisotropic(path, network),
        };
        written.with_context(|| format!("{}: cannot be written", path.display()))
    }
}

/// Where fits begin: the shared start of the built-in library, or random weights where widths differ.
pub fn start(seed: u64, hidden: [usize; 2]) -> Nbrdf {
    match builtin::shared().shared_start() {
        Some(start) if start.hidden() == hidden => start.clone(),
        _ => random_hidden(seed, 0, hidden),
    }
}
