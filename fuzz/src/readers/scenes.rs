//! Scenes and the meshes they name.

use std::fs;
use std::sync::Arc;

use glam::DVec3;
use nbrdf_core::scene::{Hit, Mesh, Ray, Scene, Shape};
use tempfile::TempDir;

/// A folder with what a scene may name: `cube.obj`, `part.toml`, `map.hdr`.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let seeds = concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/seeds");
        for (name, from) in [("cube.obj", "obj/cube"), ("part.toml", "scene/part"), ("map.hdr", "hdr/softbox")] {
            fs::copy(format!("{seeds}/{from}"), folder.path().join(name)).unwrap();
        }
        Self(folder)
    }
}

/// A scene's TOML, with the files beside it; rays are followed through it.
pub fn scene(bytes: &[u8]) -> bool {
    thread_local! {
        static FOLDER: Folder = Folder::new();
    }
    // The other files of this machine are none of the fuzzer's business: some of them wait for a reader.
    if ["/", "\\", ".."].iter().any(|way| bytes.windows(way.len()).any(|window| window == way.as_bytes())) {
        return false;
    }
    let read = FOLDER.with(|folder| {
        let path = folder.0.path().join("scene.toml");
        fs::write(&path, bytes).unwrap();
        Scene::load(&path)
    });
    let Ok(scene) = read else { return false };
    for ray in rays(scene.camera.from) {
        if let Some((object, hit)) = scene.hit(&ray) {
            assert!(object < scene.objects.len());
            assert_sound(&hit);
        }
        scene.is_clear(&ray, 1.0);
    }
    true
}

/// A mesh in glTF, which rays meet.
pub fn gltf(bytes: &[u8]) -> bool {
    Mesh::of_gltf(bytes).map(meet).is_ok()
}

/// A mesh in OBJ, which rays meet.
pub fn obj(bytes: &[u8]) -> bool {
    Mesh::of_obj(bytes).map(meet).is_ok()
}

fn meet(mesh: Mesh) {
    assert!(!mesh.is_empty() && mesh.centre().is_finite());
    let middle = mesh.centre();
    let shape = Shape::Mesh(Arc::new(mesh));
    rays(middle + DVec3::splat(3.0))
        .into_iter()
        .filter_map(|ray| shape.hit(&ray, f64::INFINITY))
        .for_each(|hit| assert_sound(&hit));
}

/// Rays along the axes and aslant.
fn rays(origin: DVec3) -> [Ray; 4] {
    [DVec3::X, DVec3::NEG_Z, DVec3::splat(-1.0), DVec3::new(0.3, -0.2, -1.0)]
        .map(|direction| Ray { origin, direction: direction.normalize() })
}

fn assert_sound(hit: &Hit) {
    assert!(hit.distance > 0.0 && hit.distance.is_finite(), "{hit:?}");
    assert!((hit.normal.length() - 1.0).abs() < 1e-6 && (hit.geometric.length() - 1.0).abs() < 1e-6, "{hit:?}");
}
