//! Which scene is planned, and how.

use std::path::PathBuf;

use nbrdf_core::plan::By;
use serde::{Deserialize, Serialize};

use crate::worker::scene::{Source, Wish};

/// Least and most mean FLIP that can be allowed.
pub const TOLERANCES: [f64; 2] = [0.001, 0.5];

/// Which of a scene's pictures is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shown {
    /// The materials themselves.
    Reference,
    /// The chosen models.
    #[default]
    Planned,
    /// How the two differ.
    Difference,
}

/// A scene, and what its models must be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Scene {
    /// Where it comes from; none before one was opened.
    pub source: Option<Source>,
    /// Counts how often a scene was opened, so that a file is read again.
    #[serde(skip)]
    pub reading: u32,
    /// Mean FLIP that an object's pixels may have; that of the scene where none was chosen.
    pub tolerance: Option<f64>,
    /// What is to be least.
    pub by: By,
    /// The object that is looked at, by its name.
    pub selected: Option<String>,
    /// Which picture is shown.
    pub shown: Shown,
}

impl Default for Scene {
    fn default() -> Self {
        Self { source: None, reading: 0, tolerance: None, by: By::Time, selected: None, shown: Shown::default() }
    }
}

impl Scene {
    /// Opens a scene, or reads the present one again; its own tolerance counts then.
    pub fn open(&mut self, source: Source) {
        if self.source.as_ref() != Some(&source) {
            (self.tolerance, self.selected) = (None, None);
        }
        self.source = Some(source);
        self.reading = self.reading.wrapping_add(1);
    }

    /// Opens a file.
    pub fn open_file(&mut self, path: PathBuf) {
        // The next start may be from another folder.
        self.open(Source::File(std::path::absolute(&path).unwrap_or(path)));
    }

    /// Selects an object, or none where it was selected already.
    pub fn select(&mut self, object: &str) {
        let is_new = self.selected.as_deref() != Some(object);
        self.selected = is_new.then(|| object.to_owned());
    }

    /// What the worker is to do.
    pub fn wish(&self) -> Option<Wish> {
        let Self { source, reading, tolerance, by, .. } = self;
        // A file of a session may hold anything.
        let tolerance =
            tolerance.filter(|value| value.is_finite()).map(|value| value.clamp(TOLERANCES[0], TOLERANCES[1]));
        Some(Wish { source: source.clone()?, reading: *reading, tolerance, by: *by })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_scene_has_its_own_tolerance_and_the_same_one_keeps_what_was_chosen() {
        let mut scene = Scene::default();
        assert_eq!(scene.wish(), None);
        scene.open_file("a.toml".into());
        scene.tolerance = Some(0.1);
        scene.select("ball");
        let before = scene.wish();
        scene.open_file("a.toml".into());
        assert_eq!((scene.tolerance, scene.selected.as_deref()), (Some(0.1), Some("ball")));
        assert_ne!(scene.wish(), before, "read again");
        scene.open(Source::Example("shelf".to_owned()));
        assert_eq!((scene.tolerance, scene.selected), (None, None));
    }

    #[test]
    fn a_tolerance_of_nonsense_is_none() {
        let scene = |tolerance| Scene {
            source: Some(Source::Example("shelf".to_owned())),
            tolerance: Some(tolerance),
            ..Scene::default()
        };
        let of = |tolerance| scene(tolerance).wish().and_then(|wish| wish.tolerance);
        assert_eq!([of(f64::NAN), of(-1.0), of(9.0)], [None, Some(0.001), Some(0.5)]);
    }
}
