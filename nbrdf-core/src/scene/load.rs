//! A mesh by itself, from any file that holds one.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use super::obj::Meshes;
use super::{Mesh, SceneError, gltf};

impl Mesh {
    /// Endings of files that [`load`](Self::load) reads.
    pub const ENDINGS: [&'static str; 3] = ["obj", "gltf", "glb"];

    /// Reads everything in a file as one mesh: glTF by the ending `.gltf` or `.glb`, else Wavefront OBJ.
    ///
    /// # Errors
    /// [`SceneError`] naming the file: not there, too large, no mesh of its kind, corners that lead nowhere.
    pub fn load(path: &Path) -> Result<Arc<Self>, SceneError> {
        let is = |ending: &str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending));
        match is("gltf") || is("glb") {
            true => gltf::load(path).map(Arc::new),
            false => Meshes::default().load(path, 1.0, DVec3::ZERO),
        }
    }
}
