//! The materials that are there: the built-in ones, then those of files.
//!
//! A name belongs to a file: a file that is read again puts its materials in the place of those it gave before, under the
//! same names, and a name that the last session knew of another file stays free for it. Built-in names are never taken.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{PoisonError, RwLock};

use nbrdf_core::{Material, measured};

/// Files of materials by name.
pub type Origins = BTreeMap<String, PathBuf>;

/// All materials, in the order of the list.
#[derive(Default)]
pub(super) struct Materials(RwLock<List>);

#[derive(Default)]
struct List {
    entries: Vec<(Material, Option<PathBuf>)>,
    /// Names that belong to files, whether they were read or not.
    claims: Origins,
}

/// What became of the materials of a file.
pub(super) struct Added {
    /// Under the names that they have now.
    pub materials: Vec<Material>,
    /// Names of those that it gave before: they mean something else now, or nothing.
    pub changed: Vec<String>,
}

impl Materials {
    /// The built-in ones.
    pub fn new(built_in: Vec<Material>) -> Self {
        let entries = built_in.into_iter().map(|material| (material, None)).collect();
        Self(RwLock::new(List { entries, claims: Origins::new() }))
    }

    /// Leaves names to files that may be read later.
    pub fn claim(&self, origins: Origins) {
        self.0.write().unwrap_or_else(PoisonError::into_inner).claims.extend(origins);
    }

    /// The one of this name.
    pub fn get(&self, name: &str) -> Option<Material> {
        let list = self.0.read().unwrap_or_else(PoisonError::into_inner);
        list.entries.iter().find(|(material, _)| material.name == name).map(|(material, _)| material.clone())
    }

    /// All of them.
    pub fn all(&self) -> Vec<Material> {
        let list = self.0.read().unwrap_or_else(PoisonError::into_inner);
        list.entries.iter().map(|(material, _)| material.clone()).collect()
    }

    /// Adds the materials of a file, in place of those it gave before.
    pub fn put(&self, file: &Path, materials: Vec<Material>) -> Added {
        let mut list = self.0.write().unwrap_or_else(PoisonError::into_inner);
        let List { entries, claims } = &mut *list;
        let is_own = |(_, from): &(Material, Option<PathBuf>)| from.as_deref() == Some(file);
        let place = entries.iter().position(is_own).unwrap_or(entries.len());
        let changed = entries.extract_if(.., |entry| is_own(entry)).map(|(material, _)| material.name).collect();
        let mut added: Vec<Material> = Vec::new();
        for material in materials {
            let others = || entries.iter().map(|(known, _)| known);
            let is_unused = |name: &String| others().chain(&added).all(|known| known.name != *name);
            let is_mine = |name: &String| claims.get(name).is_some_and(|of| of == file);
            let mine = names(&material.name, file).take(CANDIDATES).find(|name| is_mine(name) && is_unused(name));
            let is_free = |name: &String| is_unused(name) && (is_mine(name) || !claims.contains_key(name));
            let name = mine.or_else(|| names(&material.name, file).find(is_free));
            added.extend(name.map(|name| Material { name, ..material }));
        }
        entries.splice(place..place, added.iter().map(|material| (material.clone(), Some(file.to_owned()))));
        claims.retain(|_, of| of != file);
        claims.extend(added.iter().map(|material| (material.name.clone(), file.to_owned())));
        Added { materials: added, changed }
    }

    /// Adds a material that came from no file, beside whatever is there.
    pub fn add(&self, material: Material) -> Material {
        let mut list = self.0.write().unwrap_or_else(PoisonError::into_inner);
        let is_free = |name: &String| {
            list.entries.iter().all(|(known, _)| known.name != *name) && !list.claims.contains_key(name)
        };
        let name = names(&material.name, Path::new("pasted")).find(is_free).unwrap_or_default();
        let material = Material { name, ..material };
        list.entries.push((material.clone(), None));
        material
    }
}

/// Names that do not depend on what else is open, before numbers begin.
const CANDIDATES: usize = 3;

/// What a material of a file may be called, best first.
fn names(own: &str, file: &Path) -> impl Iterator<Item = String> {
    let stem = measured::name_of(file);
    let folder = file.parent().and_then(Path::file_name).map(|folder| folder.to_string_lossy().into_owned());
    let place = folder.map_or_else(|| stem.clone(), |folder| format!("{folder}/{stem}"));
    let numbered = (2_u32..).map({
        let (own, place) = (own.to_owned(), place.clone());
        move |number| format!("{own} ({place} {number})")
    });
    [own.to_owned(), format!("{own} ({stem})"), format!("{own} ({place})")].into_iter().chain(numbered)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nbrdf_core::Rgb;
    use nbrdf_core::brdf::lambert::Lambert;

    use super::*;

    fn grey(name: &str) -> Material {
        Material::new(name, Arc::new(Lambert { albedo: Rgb::splat(0.5) }))
    }

    fn list() -> Materials {
        Materials::new(vec![grey("chrome")])
    }

    fn put(materials: &Materials, file: &str, names: &[&str]) -> Vec<String> {
        let added = materials.put(Path::new(file), names.iter().map(|name| grey(name)).collect());
        added.materials.into_iter().map(|material| material.name).collect()
    }

    fn all(materials: &Materials) -> Vec<String> {
        materials.all().into_iter().map(|material| material.name).collect()
    }

    #[test]
    fn a_file_that_is_read_again_replaces_its_own_materials() {
        let materials = list();
        put(&materials, "/a/ours.npz", &["felt", "wool"]);
        let before = materials.get("felt").unwrap();
        let added = materials.put(Path::new("/a/ours.npz"), vec![grey("felt")]);
        assert_eq!(added.changed, ["felt", "wool"]);
        assert_eq!(all(&materials), ["chrome", "felt"]);
        assert!(!Arc::ptr_eq(&before.brdf, &materials.get("felt").unwrap().brdf));
    }

    #[test]
    fn built_in_names_are_never_taken_and_two_files_may_hold_one_name() {
        let materials = list();
        assert_eq!(put(&materials, "/a/ours.npz", &["chrome", "felt"]), ["chrome (ours)", "felt"]);
        assert_eq!(put(&materials, "/b/theirs.npz", &["felt"]), ["felt (theirs)"]);
        assert_eq!(put(&materials, "/c/theirs.npz", &["felt", "felt"]), ["felt (c/theirs)", "felt (c/theirs 2)"]);
    }

    #[test]
    fn names_of_the_last_session_come_back_in_whatever_order_files_are_read() {
        let files = [("/a/ours.npz", &["felt"]), ("/b/theirs.npz", &["felt"]), ("/c/theirs.npz", &["felt"])];
        let first = list();
        let before: Vec<_> = files.iter().map(|(file, names)| (*file, put(&first, file, *names))).collect();
        let origins = || before.iter().flat_map(|(file, names)| names.iter().map(|name| (name.clone(), file.into())));
        for order in [[2, 1, 0], [1, 2, 0], [1, 0, 2]] {
            let next = list();
            next.claim(origins().collect());
            for place in order {
                assert_eq!(put(&next, files[place].0, files[place].1), before[place].1, "{order:?}");
            }
        }
        // One of them is missing, and another comes.
        let next = list();
        next.claim(origins().collect());
        assert_eq!(put(&next, "/d/new.npz", &["felt"]), ["felt (new)"]);
        assert_eq!(put(&next, "/a/ours.npz", &["felt"]), ["felt"]);
    }

    #[test]
    fn what_was_pasted_stays_beside_all_others() {
        let materials = list();
        let names: Vec<String> = (0..3).map(|_| materials.add(grey("chrome")).name).collect();
        assert_eq!(names, ["chrome (pasted)", "chrome (pasted 2)", "chrome (pasted 3)"]);
    }
}
