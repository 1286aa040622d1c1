//! What a file's name says about its contents.

use crate::nbrdf::ARRAYS;

/// The forms a network is read in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Keras `.h5` (or `.hdf5`), as published.
    Keras,
    /// Six arrays in one `.npz`.
    Npz,
    /// One tensor in a `.safetensors`.
    Safetensors,
    /// One of six `.npy`; its place in [`ARRAYS`].
    Npy(usize),
}

impl Form {
    /// Extensions of files that may hold a network, or one of six arrays of it.
    pub const EXTENSIONS: [&str; 5] = ["h5", "hdf5", "npz", "safetensors", "npy"];

    /// Form and stem of a file name without folders; none for what is not a network (`.json`, hidden files, ...).
    pub fn of(file_name: &str) -> Option<(Self, &str)> {
        // Archives made on macOS carry a hidden `._chrome.h5` beside `chrome.h5`.
        let (stem, extension) = file_name.rsplit_once('.').filter(|_| !file_name.starts_with('.'))?;
        let form = match extension.to_ascii_lowercase().as_str() {
            "h5" | "hdf5" => Self::Keras,
            "npz" => Self::Npz,
            "safetensors" => Self::Safetensors,
            "npy" => {
                let (stem, array) = stem.rsplit_once('_')?;
                let place = ARRAYS.iter().position(|known| *known == array)?;
                return (!stem.is_empty()).then_some((Self::Npy(place), stem));
            }
            _ => return None,
        };
        Some((form, stem))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_form_and_stem() {
        assert_eq!(Form::of("chrome.h5"), Some((Form::Keras, "chrome")));
        assert_eq!(Form::of("paper_white_rgb.NPZ"), Some((Form::Npz, "paper_white_rgb")));
        assert_eq!(Form::of("paper_white_rgb_b2.npy"), Some((Form::Npy(3), "paper_white_rgb")));
        assert_eq!(Form::of("my.paint.v2.safetensors"), Some((Form::Safetensors, "my.paint.v2")));
    }

    #[test]
    fn every_extension_that_is_listed_is_read() {
        let of = |extension: &str| Form::of(&format!("a_b1.{extension}")).is_some();
        assert!(Form::EXTENSIONS.into_iter().all(of));
    }

    #[test]
    fn what_is_not_a_network_has_no_form() {
        for name in ["chrome.json", "README", "._chrome.h5", ".h5", "chrome_fc4.npy", "fc1.npy", "_fc1.npy", ""] {
            assert_eq!(Form::of(name), None, "{name}");
        }
    }
}
