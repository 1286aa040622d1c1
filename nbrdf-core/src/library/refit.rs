//! Fits a library again: all networks from one shared start, or each from a random start of its own.

use std::sync::Arc;

use super::{Entry, Library, LibraryError, Provenance};
use crate::metric::{ImageMetric, Metric, Rendered};
use crate::nbrdf::fit::{FitOptions, fit, fit_all, random_network};
use crate::path::mix::{Mix, Mixed};
use crate::{Brdf, Database, Nbrdf};

/// Where the fits of a library begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// All from one network, itself fitted to the mean of the training materials.
    Shared,
    /// Each from its own random network, as published networks are.
    Independent,
}

/// Something done, of how much in all.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// The shared start is being fitted.
    FittingStart,
    /// One material is done.
    Fitted,
}

/// Why there is no refitted library.
#[derive(Debug, thiserror::Error)]
pub enum RefitError {
    /// Cancelled by the user.
    #[error("cancelled")]
    Cancelled,
    /// No material to take the mean of.
    #[error("a shared start needs training materials, and all {found} materials are held out")]
    NothingToLearnFrom {
        /// Materials given.
        found: usize,
    },
    /// The fitted networks make no library.
    #[error(transparent)]
    Library(#[from] LibraryError),
}

/// Fits every entry's reflectance again. Each entry of the result carries its error against the entry given.
///
/// Same seed and entries, same bits, for any number of threads. The shared start sees no held-out material: it is
/// fitted to the mean of ln(1 + f) of the MERL training materials, or of all training materials where none is MERL's.
pub fn refit(
    entries: &[Entry],
    start: Start,
    options: FitOptions,
    provenance: Provenance,
    progress: &(dyn Fn(Event) + Sync),
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Library, RefitError> {
    let shared = match start {
        Start::Shared => {
            progress(Event::FittingStart);
            let random = random_network(options.seed, 0);
            let mean = mean_material(entries)?;
            Some(
                fit(&random, &mean, FitOptions { proximity: 0.0, ..options }, cancelled)
                    .ok_or(RefitError::Cancelled)?,
            )
        }
        Start::Independent => None,
    };
    let start = |stream: usize| shared.clone().unwrap_or_else(|| random_network(options.seed, 1 + stream as u64));
    let jobs: Vec<(Nbrdf, &dyn Brdf)> =
        entries.iter().enumerate().map(|(i, entry)| (start(i), &entry.network as &dyn Brdf)).collect();
    let done = || progress(Event::Fitted);
    let fitted = fit_all(&jobs, options, &done, cancelled).ok_or(RefitError::Cancelled)?;
    let fitted = entries.iter().zip(fitted).map(|(entry, network)| with_errors(entry, network)).collect();
    Ok(Library::new(provenance, shared, fitted)?)
}

/// The mean of ln(1 + f) over the training materials.
fn mean_material(entries: &[Entry]) -> Result<Mixed, RefitError> {
    let training = || entries.iter().filter(|entry| !entry.held_out);
    let merl: Vec<&Entry> = training().filter(|entry| entry.database == Database::Merl).collect();
    let chosen = if merl.is_empty() { training().collect() } else { merl };
    if chosen.is_empty() {
        return Err(RefitError::NothingToLearnFrom { found: entries.len() });
    }
    let share = 1.0 / chosen.len() as f32;
    let part = |entry: &Entry| (share, Arc::new(entry.network.clone()) as Arc<dyn Brdf>);
    Ok(Mixed::new(Mix::Log1p, chosen.into_iter().map(part).collect()))
}

/// The refitted entry, and how far it is from the one it was fitted to.
fn with_errors(entry: &Entry, network: Nbrdf) -> Entry {
    let metrics: [Box<dyn Metric>; 3] = [
        Box::new(crate::metric::LogError),
        Box::new(crate::metric::RelativeLog),
        Box::new(Rendered::studio(ImageMetric::Psnr)),
    ];
    let error = metrics.iter().map(|m| (m.name().to_owned(), m.distance(&entry.network, &network))).collect();
    Entry { error, network, ..entry.clone() }
}
