//! Maps or meshes by what they are known as: the built-in one first, then those of files in the order of their arrival.

use std::path::Path;
use std::sync::{PoisonError, RwLock};

use super::Asset;

/// One map or mesh, as it is listed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Listed {
    /// Which it is.
    pub asset: Asset,
    /// Its name for people; two files may have one name.
    pub name: String,
}

impl Listed {
    /// What is always there.
    pub fn built_in(name: &str) -> Self {
        Self { asset: Asset::BuiltIn, name: name.to_owned() }
    }

    /// What people call one of a list; one whose file is missing says so.
    pub fn title(all: &[Self], asset: Asset) -> String {
        let known = all.iter().find(|listed| listed.asset == asset);
        known.map_or_else(|| format!("{} (missing)", name_of(asset)), |listed| listed.name.clone())
    }
}

/// All maps, or all meshes.
pub(super) struct Assets<T> {
    built_in: (Listed, T),
    others: RwLock<Vec<(Listed, T)>>,
}

impl<T: Clone> Assets<T> {
    /// The built-in one alone.
    pub fn new(name: &str, thing: T) -> Self {
        Self { built_in: (Listed::built_in(name), thing), others: RwLock::default() }
    }

    /// Adds what a file holds, or puts it in the place of what it held before: maps are large.
    pub fn put(&self, path: &Path, thing: T) -> Asset {
        let asset = Asset::of_file(path);
        let mut others = self.others.write().unwrap_or_else(PoisonError::into_inner);
        match others.iter_mut().find(|(listed, _)| listed.asset == asset) {
            Some((_, known)) => *known = thing,
            None => others.push((Listed { asset, name: name_of(asset) }, thing)),
        }
        asset
    }

    /// What is shown of one: the built-in one while its file is missing.
    pub fn get(&self, asset: Asset) -> (Listed, T) {
        let others = self.others.read().unwrap_or_else(PoisonError::into_inner);
        others.iter().find(|(listed, _)| listed.asset == asset).unwrap_or(&self.built_in).clone()
    }

    /// All of them.
    pub fn listed(&self) -> Vec<Listed> {
        let others = self.others.read().unwrap_or_else(PoisonError::into_inner);
        std::iter::once(&self.built_in).chain(others.iter()).map(|(listed, _)| listed.clone()).collect()
    }
}

fn name_of(asset: Asset) -> String {
    let stem = asset.file().and_then(Path::file_stem);
    stem.map_or_else(|| "Built-in".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_by_its_file_does_not_move_when_another_is_lost() {
        let [first, second] = ["/a/room.exr", "/a/street.exr"].map(Path::new);
        let full = Assets::new("plain", 0);
        let [room, street] = [full.put(first, 1), full.put(second, 2)];
        // The next start, without the first file.
        let assets = Assets::new("plain", 0);
        assert_eq!(assets.put(second, 2), street);
        assert_eq!([room, street, Asset::BuiltIn].map(|asset| assets.get(asset).1), [0, 2, 0]);
        assert_eq!(Listed::title(&assets.listed(), room), "room (missing)");
        assert_eq!(Listed::title(&assets.listed(), street), "street");
    }

    #[test]
    fn a_file_that_is_read_again_takes_its_own_place() {
        let assets = Assets::new("plain", 0);
        let room = assets.put(Path::new("/a/room.exr"), 1);
        assert_eq!(assets.put(Path::new("/a/room.exr"), 5), room);
        assert_eq!((assets.listed().len(), assets.get(room).1), (2, 5));
    }
}
