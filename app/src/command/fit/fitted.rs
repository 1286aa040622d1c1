//! What a fit gives: a network, and what it reads.

use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::measured::Measured;
use nbrdf_core::metric::{albedo_max, albedo_max_around};
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::nbrdf::file;
use nbrdf_core::nbrdf::fit::{FitOptions, fit, fit_anisotropic, fit_list, fit_list_anisotropic};
use nbrdf_core::sample_list::SampleList;
use nbrdf_core::{Brdf, Nbrdf};

use crate::progress;

/// A network of either kind.
pub enum Fitted {
    /// Of a material that is the same however it is turned.
    Isotropic(Nbrdf),
    /// Of one that is not.
    Turning(AnisotropicNbrdf),
}

impl Fitted {
    /// Fits to a measurement.
    pub fn to(
        measured: &Measured,
        turns: bool,
        start: &Nbrdf,
        options: FitOptions,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<Self> {
        let fitted = match measured {
            Measured::Somewhere(list) => return Self::to_list(list, turns, start, options, cancelled),
            Measured::Everywhere(table) | Measured::Turning(table) => match turns {
                true => fit_anisotropic(start, table.as_ref(), options, cancelled).map(Self::Turning),
                false => fit(start, table.as_ref(), options, cancelled).map(Self::Isotropic),
            },
        };
        Self::done(fitted)
    }

    /// Fits to samples.
    pub fn to_list(
        list: &SampleList,
        turns: bool,
        start: &Nbrdf,
        options: FitOptions,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<Self> {
        Self::done(match turns {
            true => fit_list_anisotropic(start, list, options, cancelled).map(Self::Turning),
            false => fit_list(start, list, options, cancelled).map(Self::Isotropic),
        })
    }

    fn done(fitted: Option<Self>) -> Result<Self> {
        progress::check()?;
        fitted.context("the fit has diverged: are all measured values finite?")
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

    /// Writes it in the form of the path's extension.
    pub fn write(&self, path: &Path) -> Result<()> {
        let written = match self {
            Self::Isotropic(network) => file::write(path, network),
            Self::Turning(network) => file::write_anisotropic(path, network),
        };
        written.with_context(|| format!("{}: cannot be written", path.display()))
    }
}
