//! What took time to make and can be made again: thumbnails, properties and fitted networks, in files named by what they
//! were made from.

mod prune;

use std::path::PathBuf;
use std::sync::OnceLock;

use nbrdf_core::hash::sha256;
use nbrdf_core::sampling::{evaluate, turned_rus32k};
use nbrdf_core::{Directions, Material, Rgb, atomic, bounded};

/// Names the folder instead of the system's place for it; empty for none.
const VARIABLE: &str = "NBRDF_CACHE";
/// Changes whenever what is kept would be made otherwise.
const VERSION: u32 = 1;
/// Digits of the checksum that a file begins with.
const CHECKSUM: usize = 64;
/// Largest file read \[bytes\]; a network of the largest widths has fewer.
const MOST_BYTES: u64 = 8 << 20;
/// Every so many pairs of directions are asked of what has no network.
const EVERY: usize = 32;

/// A folder of files; none, where nothing is kept.
#[derive(Clone, Debug, Default)]
pub struct Cache(pub Option<PathBuf>);

/// What is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Thumbnail,
    Qualities,
    Error,
    Network,
}

impl Kind {
    const ALL: [Self; 4] = [Self::Thumbnail, Self::Qualities, Self::Error, Self::Network];

    const fn extension(self) -> &'static str {
        match self {
            Self::Thumbnail => "thumbnail",
            Self::Qualities => "qualities",
            Self::Error => "error",
            Self::Network => "network",
        }
    }
}

impl Cache {
    /// In the system's cache folder, or the one that the variable `NBRDF_CACHE` names.
    pub fn of_system() -> Self {
        Self(match std::env::var_os(VARIABLE) {
            Some(own) => (!own.is_empty()).then(|| own.into()),
            None => directories::ProjectDirs::from("", "", "nbrdf").map(|place| place.cache_dir().to_owned()),
        })
    }

    /// What is kept under a key; a damaged file is none.
    pub(super) fn get(&self, kind: Kind, key: &str) -> Option<Vec<u8>> {
        let file = self.file(kind, key)?;
        let mut bytes = bounded::read(&file, MOST_BYTES).ok()??;
        prune::touch(&file);
        let checksum = bytes.get(..CHECKSUM)?.to_owned();
        bytes.drain(..CHECKSUM);
        (sha256(&bytes).as_bytes() == checksum).then_some(bytes)
    }

    /// Keeps something. A folder that cannot be written only costs time at the next start, so nobody is told.
    pub(super) fn put(&self, kind: Kind, key: &str, bytes: &[u8]) {
        let Some(file) = self.file(kind, key) else { return };
        let made = file.parent().map_or(Ok(()), std::fs::create_dir_all);
        let mut all = sha256(bytes).into_bytes();
        all.extend(bytes);
        let _ = made.and_then(|()| atomic::write(&file, &all));
    }

    fn file(&self, kind: Kind, key: &str) -> Option<PathBuf> {
        Some(self.0.as_ref()?.join(format!("{key}.{}", kind.extension())))
    }
}

/// A key for what is made from these parts.
pub(super) fn key(parts: &[&[u8]]) -> String {
    let mut all = VERSION.to_le_bytes().to_vec();
    for part in parts {
        all.extend((part.len() as u64).to_le_bytes());
        all.extend(*part);
    }
    sha256(&all)
}

/// A mark of a reflectance: of its network where it has one, else of its values.
pub(super) fn mark(material: &Material) -> String {
    static PLACES: OnceLock<Vec<Directions>> = OnceLock::new();
    let bytes = |numbers: &[f32]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    match &material.network {
        Some(network) => {
            let [first, second] = network.hidden().map(|width| width as u64);
            key(&[&first.to_le_bytes(), &second.to_le_bytes(), &bytes(network.weights())])
        }
        None => {
            let at = PLACES.get_or_init(|| turned_rus32k().into_iter().step_by(EVERY).collect());
            key(&[&bytes(Rgb::flat(&evaluate(material.brdf.as_ref(), at)))])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbrdf_core::library::builtin;

    #[test]
    fn what_is_kept_is_found_and_what_is_damaged_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache(Some(folder.path().join("deep")));
        assert_eq!(cache.get(Kind::Error, "a"), None);
        cache.put(Kind::Error, "a", b"0.5");
        assert_eq!(cache.get(Kind::Error, "a").unwrap(), b"0.5");
        assert_eq!(cache.get(Kind::Network, "a"), None, "kinds do not mix");
        let file = cache.file(Kind::Error, "a").unwrap();
        for damage in [&b"short"[..], &[0; 80]] {
            std::fs::write(&file, damage).unwrap();
            assert_eq!(cache.get(Kind::Error, "a"), None);
        }
        cache.put(Kind::Error, "a", b"0.6");
        assert_eq!(cache.get(Kind::Error, "a").unwrap(), b"0.6");
    }

    #[test]
    fn without_a_folder_nothing_is_kept() {
        let cache = Cache::default();
        cache.put(Kind::Error, "a", b"0.5");
        assert_eq!(cache.get(Kind::Error, "a"), None);
    }

    #[test]
    fn every_material_has_a_mark_of_its_own_and_none_of_its_name() {
        let mut marks: Vec<_> = builtin::shared().materials().iter().map(mark).collect();
        marks.sort_unstable();
        marks.dedup();
        assert_eq!(marks.len(), builtin::shared().len());
        let chrome = builtin::shared().get("chrome").unwrap().material();
        assert_eq!(mark(&chrome), mark(&Material { name: "other".to_owned(), ..chrome.clone() }));
        let nameless = |material: &Material| Material::new("table", std::sync::Arc::clone(&material.brdf));
        let gold = builtin::shared().get("gold-paint").unwrap().material();
        assert_ne!(mark(&nameless(&chrome)), mark(&nameless(&gold)));
    }
}
