//! A scene: objects of named materials, lights and a camera, read from TOML (`docs/scenes.md` says every key).
//!
//! World space is that of environments: +y up, right-handed; lengths are in any unit. Light is direct light: lamps,
//! luminous rectangles and an environment, with shadows; what surfaces throw on each other is left out, so that a
//! picture is linear in every material's reflectance, and what it asks of them is known after one pass ([`View`]).

mod camera;
mod demand;
mod error;
mod file;
mod gltf;
mod include;
mod keys;
mod knot;
mod lamp;
mod load;
mod mesh;
mod obj;
mod ray;
mod shape;
mod value;
mod view;

use std::path::{Path, PathBuf};

pub use camera::Camera;
pub use demand::Demand;
pub use error::{SceneError, SceneProblem};
pub use lamp::Lamp;
pub use mesh::{Mesh, Triangle};
pub use ray::{Hit, Ray};
pub use shape::Shape;
pub use view::{Gathering, View};

/// Pixels per side at most.
pub const MAX_SIDE: usize = 4096;
/// Pairs of directions that a picture may ask for: 0.6 GB, and twice as much while it is looked at.
pub const MAX_PAIRS: usize = 1 << 24;
/// Objects, and lights, at most.
pub const MAX_OBJECTS: usize = 1000;

/// Everything that a picture is made of, but for what the materials reflect.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Size and exposure.
    pub picture: Picture,
    /// Mean FLIP that an object's pixels may have, where the command line does not say otherwise.
    pub tolerance: Option<f64>,
    /// Where it is seen from.
    pub camera: Camera,
    /// What shines.
    pub lamps: Vec<Lamp>,
    /// What is seen.
    pub objects: Vec<Object>,
}

/// Size and exposure of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// Pixels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Rays through every pixel; each meets every light once.
    pub samples: usize,
    /// Stops.
    pub exposure: f64,
}

/// A shape of one material.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its name in reports.
    pub name: String,
    /// The material: a name, or a file.
    pub material: String,
    /// Where relative paths begin.
    pub folder: PathBuf,
    /// Its shape.
    pub shape: Shape,
}

impl Scene {
    /// Reads a scene with everything it includes.
    ///
    /// # Errors
    /// [`SceneError`] naming the file: not there, no TOML, unknown or missing keys, numbers out of range, no objects or
    /// lights, includes that are missing or lead back to where they came from, meshes and maps that cannot be read.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        file::load(path)
    }

    /// The nearest surface along a ray, and whose it is.
    pub fn hit(&self, ray: &Ray) -> Option<(usize, Hit)> {
        let mut nearest: Option<(usize, Hit)> = None;
        for (index, object) in self.objects.iter().enumerate() {
            let limit = nearest.as_ref().map_or(f64::INFINITY, |(_, hit)| hit.distance);
            if let Some(hit) = object.shape.hit(ray, limit) {
                nearest = Some((index, hit));
            }
        }
        nearest
    }

    /// Whether nothing stands in the way for this distance.
    pub fn is_clear(&self, ray: &Ray, distance: f64) -> bool {
        self.objects.iter().all(|object| object.shape.hit(ray, distance).is_none())
    }

    /// The same scene from `factor` times as far from the middle of an object.
    ///
    /// # Panics
    /// If there is no such object (a bug of the caller).
    #[must_use]
    pub fn from_afar(&self, object: usize, factor: f64) -> Self {
        let camera = self.camera.moved_away(self.objects[object].shape.centre(), factor);
        Self { camera, ..self.clone() }
    }
}

#[cfg(test)]
mod tests;
