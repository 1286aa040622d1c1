//! Networks as files.

use std::sync::Arc;

use anyhow::{Result, bail};
use nbrdf_core::nbrdf::{keras, npy, safetensors};
use nbrdf_core::{Brdf, Nbrdf};

use super::entry::first;
use super::{ExporterEntry, Needs};

/// What weights mean.
const WEIGHTS: &str = "weights of a network 6-n-m-3 of h.x h.y h.z d.x d.y d.z (half, difference); relu, relu, exp(y) - 1 clamped at 0 is f_r \
                       [1/sr], linear RGB, without the cosine";

/// Six arrays in one archive.
pub(super) const NPZ: ExporterEntry = ExporterEntry {
    name: "npz",
    extension: "npz",
    about: "a network: six NumPy arrays in one archive",
    needs: Needs::Network,
    convention: WEIGHTS,
    tolerance: None,
    ends: &[".npz"],
    write: |subject, _| Ok(subject.network().map(|network| vec![npy::write_npz(network)])),
    read: |files, _| alone(files, |bytes| Ok(npy::read_npz(bytes)?)),
};

/// One tensor.
pub(super) const SAFETENSORS: ExporterEntry = ExporterEntry {
    name: "safetensors",
    extension: "safetensors",
    about: "a network: one tensor",
    needs: Needs::Network,
    convention: WEIGHTS,
    tolerance: None,
    ends: &[".safetensors"],
    write: |subject, _| {
        let plain = subject.network().map(safetensors::write_safetensors);
        Ok(plain.or_else(|| subject.turning().map(safetensors::write_anisotropic)).map(|bytes| vec![bytes]))
    },
    read: |files, _| match safetensors::read_anisotropic(first(files))? {
        Some(turning) => Ok(Arc::new(turning)),
        None => alone(files, |bytes| Ok(safetensors::read_safetensors(bytes)?)),
    },
};

/// Six arrays, a file each.
pub(super) const NPY: ExporterEntry = ExporterEntry {
    name: "npy",
    extension: "npy",
    about: "a network: six files, one NumPy array each",
    needs: Needs::Network,
    convention: WEIGHTS,
    tolerance: None,
    ends: &["_fc1.npy", "_b1.npy", "_fc2.npy", "_b2.npy", "_fc3.npy", "_b3.npy"],
    write: |subject, _| Ok(subject.network().map(|network| npy::write_npy(network).into())),
    read: |files, _| match files {
        [a, b, c, d, e, f] => Ok(Arc::new(npy::read_npy([a, b, c, d, e, f])?)),
        _ => bail!("expected six arrays, found {}", files.len()),
    },
};

/// Weights and architecture, a file each.
pub(super) const KERAS: ExporterEntry = ExporterEntry {
    name: "keras",
    extension: "h5",
    about: "a network: weights as the published ones, and a .json of the layers for Keras",
    needs: Needs::Network,
    convention: WEIGHTS,
    tolerance: None,
    ends: &[".h5", ".json"],
    write: |subject, stem| {
        let Some(network) = subject.network() else { return Ok(None) };
        let architecture = keras::write_architecture(network, stem).into_bytes();
        Ok(Some(vec![keras::write_keras(network)?, architecture]))
    },
    read: |files, _| alone(files, |bytes| Ok(keras::read_keras(bytes)?)),
};

/// The network in the first file.
fn alone(files: &[&[u8]], read: fn(&[u8]) -> Result<Nbrdf>) -> Result<Arc<dyn Brdf>> {
    Ok(Arc::new(read(first(files))?))
}
