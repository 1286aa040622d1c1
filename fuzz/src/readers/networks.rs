//! Networks in files, archives and libraries.

use nbrdf_core::library::{Scanned, scan_archive};
use nbrdf_core::nbrdf::{keras::read_keras, npy, safetensors};
use nbrdf_core::{Library, Nbrdf};

use super::{assert_reflects, split};

/// What was read reflects, and every form that is written reads the same again.
fn is_sound(network: &Nbrdf) -> bool {
    assert_reflects(network);
    let [a, b, c, d, e, f] = &npy::write_npy(network);
    assert_eq!(&npy::read_npy([a, b, c, d, e, f]).unwrap(), network);
    assert_eq!(&npy::read_npz(&npy::write_npz(network)).unwrap(), network);
    assert_eq!(&safetensors::read_safetensors(&safetensors::write_safetensors(network)).unwrap(), network);
    true
}

/// Keras `.h5`.
pub fn keras(bytes: &[u8]) -> bool {
    read_keras(bytes).is_ok_and(|network| is_sound(&network))
}

/// Six `.npy`, one after the other, each after its length.
pub fn npy(bytes: &[u8]) -> bool {
    let mut rest = bytes;
    let files = [(); 6].map(|()| {
        let (file, after) = split(rest);
        rest = after;
        file
    });
    npy::read_npy(files).is_ok_and(|network| is_sound(&network))
}

/// `.npz`.
pub fn npz(bytes: &[u8]) -> bool {
    npy::read_npz(bytes).is_ok_and(|network| is_sound(&network))
}

/// `.safetensors` of one network, of either kind.
pub fn network_safetensors(bytes: &[u8]) -> bool {
    let isotropic = safetensors::read_safetensors(bytes).is_ok_and(|network| is_sound(&network));
    let turning = safetensors::read_anisotropic(bytes).ok().flatten();
    if let Some(network) = &turning {
        assert_reflects(network);
        let again = safetensors::read_anisotropic(&safetensors::write_anisotropic(network));
        assert_eq!(again.unwrap().as_ref(), Some(network));
    }
    assert!(!(isotropic && turning.is_some()), "a network is of one kind");
    isotropic || turning.is_some()
}

/// A zip archive of networks.
pub fn archive(bytes: &[u8]) -> bool {
    let Ok(scanned) = scan_archive("archive.zip", bytes) else { return false };
    let found: Vec<_> = scanned.into_iter().filter_map(|Scanned { entry, .. }| entry.ok()).collect();
    found.iter().for_each(|entry| assert_reflects(&entry.network));
    !found.is_empty()
}

/// The two files of a library of ours, the first after its length.
pub fn library(bytes: &[u8]) -> bool {
    let (tensors, manifest) = split(bytes);
    let Ok(library) = Library::from_bytes(tensors, manifest) else { return false };
    library.iter().for_each(|entry| assert_reflects(&entry.network));
    true
}
