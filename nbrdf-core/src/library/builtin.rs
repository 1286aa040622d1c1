//! The libraries the binary carries: fitted by this project, so that everything works with no download.

use std::sync::OnceLock;

use super::Library;

/// Networks fitted from one shared initial network: their weights can be walked between.
pub fn shared() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        embedded(
            include_bytes!("../../assets/shared/library.safetensors"),
            include_bytes!("../../assets/shared/manifest.json"),
        )
    })
}

/// The same materials fitted each from an initial network of its own, as published networks are.
pub fn independent() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        embedded(
            include_bytes!("../../assets/independent/library.safetensors"),
            include_bytes!("../../assets/independent/manifest.json"),
        )
    })
}

/// # Panics
/// If the files compiled in are no library: a mistake of the build, caught by the test below.
fn embedded(tensors: &[u8], manifest: &[u8]) -> Library {
    Library::from_bytes(tensors, manifest).unwrap_or_else(|error| panic!("built-in library: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_built_in_libraries_are_valid_and_name_the_same_materials() {
        let names = |library: &'static Library| library.iter().map(|entry| &entry.name).collect::<Vec<_>>();
        assert!(!shared().is_empty());
        assert_eq!(names(shared()), names(independent()));
        assert!(shared().shared_start().is_some());
        assert!(independent().shared_start().is_none());
    }
}
