//! Which map or mesh: the built-in one, or that of a file; never its place in a list, since a file that is lost would shift
//! all others.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Which map or mesh.
///
/// Copied with every request, so that each path is kept once, for as long as the program runs: there are as many as files
/// were opened or named by a session.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Asset {
    /// The one that is always there.
    #[default]
    BuiltIn,
    /// The one in a file, which may be missing.
    File(&'static Path),
}

impl Asset {
    /// Of a file, by its absolute path.
    pub fn of_file(path: &Path) -> Self {
        static PATHS: Mutex<BTreeSet<&'static Path>> = Mutex::new(BTreeSet::new());
        let mut paths = PATHS.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = paths.get(path) {
            return Self::File(known);
        }
        let path: &'static Path = Box::leak(path.to_owned().into_boxed_path());
        paths.insert(path);
        Self::File(path)
    }

    /// Its file; none of the built-in one.
    pub const fn file(self) -> Option<&'static Path> {
        match self {
            Self::BuiltIn => None,
            Self::File(path) => Some(path),
        }
    }
}

/// How sessions name one. Earlier ones had places in a list: nobody knows what was there.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    File { file: PathBuf },
    Name(String),
    Place(u64),
}

impl Serialize for Asset {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.file() {
            None => Written::Name("built-in".to_owned()),
            Some(path) => Written::File { file: path.to_owned() },
        }
        .serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Asset {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Written::deserialize(deserializer)? {
            Written::File { file } => Self::of_file(&file),
            Written::Name(_) | Written::Place(_) => Self::BuiltIn,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_asset_comes_back_from_a_session_and_a_place_of_before_is_the_built_in_one() {
        for asset in [Asset::BuiltIn, Asset::of_file(Path::new("/maps/room.exr"))] {
            let text = serde_json::to_string(&asset).unwrap();
            assert_eq!(serde_json::from_str::<Asset>(&text).unwrap(), asset, "{text}");
        }
        for text in ["0", "3", r#""another""#] {
            assert_eq!(serde_json::from_str::<Asset>(text).unwrap(), Asset::BuiltIn, "{text}");
        }
    }

    #[test]
    fn a_path_is_kept_once() {
        let [first, second] = [(); 2].map(|()| Asset::of_file(Path::new("/meshes/pot.obj")).file().unwrap());
        assert!(std::ptr::eq(first, second));
    }
}
