//! From the keys of a scene's file and of those it includes to what they mean.

use std::collections::BTreeSet;
use std::path::Path;

use super::include::Read;
use super::keys::{
    CameraKeys, ImageKeys, LightKeys, MeshKeys, ObjectKeys, PlaneKeys, RectangleKeys, SceneFile, SphereKeys,
};
use super::obj::Meshes;
use super::value::{LARGEST, SMALLEST, bright, place, positive, rectangle, unit, within};
use super::{
    Camera, Lamp, MAX_OBJECTS, MAX_PAIRS, MAX_SIDE, Object, Picture, Scene, SceneError, SceneProblem, Shape, include,
};
use crate::render::Environment;

/// See [`Scene::load`].
pub(super) fn load(path: &Path) -> Result<Scene, SceneError> {
    let files = include::read(path)?;
    count(path, &files)?;
    let missing = |what: &str| SceneProblem::value(what, "it in this file or an included one", "none").of(path);
    let (file, image) = last(&files, |keys| keys.image.as_ref()).ok_or_else(|| missing("[image]"))?;
    let picture = picture(image).map_err(|problem| problem.of(file))?;
    let (file, camera) = last(&files, |keys| keys.camera.as_ref()).ok_or_else(|| missing("[camera]"))?;
    let camera = seen_from(camera).map_err(|problem| problem.of(file))?;
    let tolerance = last(&files, |keys| keys.tolerance);
    let tolerance =
        tolerance.map(|(file, value)| positive("tolerance", value, 1.0).map_err(|problem| problem.of(file)));
    let mut scene =
        Scene { picture, tolerance: tolerance.transpose()?, camera, lamps: Vec::new(), objects: Vec::new() };
    let mut meshes = Meshes::default();
    for Read { path, keys } in &files {
        let folder = path.parent().unwrap_or_else(|| Path::new(""));
        for (index, light) in keys.light.iter().enumerate() {
            let place = format!("light {}", index + 1);
            scene.lamps.push(lamp(light, folder, &place).map_err(|problem| problem.of(path))?);
        }
        for (index, keys) in keys.object.iter().enumerate() {
            scene.objects.push(object(keys, folder, &format!("object {}", index + 1), path, &mut meshes)?);
        }
    }
    check(&scene).map_err(|problem| problem.of(path))?;
    Ok(scene)
}

/// The file that has the last word on something, and what it says: the one that includes, before those that it includes.
fn last<'a, T>(files: &'a [Read], get: impl Fn(&'a SceneFile) -> Option<T>) -> Option<(&'a Path, T)> {
    files.iter().rev().find_map(|file| Some((file.path.as_path(), get(&file.keys)?)))
}

/// Refuses too many of anything, before anything that they name is read.
fn count(path: &Path, files: &[Read]) -> Result<(), SceneError> {
    let lights = || files.iter().flat_map(|file| &file.keys.light);
    let objects: usize = files.iter().map(|file| file.keys.object.len()).sum();
    for (what, count) in [("object", objects), ("light", lights().count())] {
        if count == 0 || count > MAX_OBJECTS {
            let most = format!("1 to {MAX_OBJECTS} of them");
            return Err(SceneProblem::value(format!("[[{what}]]"), most, count).of(path));
        }
    }
    match lights().filter(|light| matches!(light, LightKeys::Environment { .. })).count() {
        0 | 1 => Ok(()),
        maps => Err(SceneProblem::value("[[light]]", "one environment at most", maps).of(path)),
    }
}

/// What only the whole shows.
fn check(scene: &Scene) -> Result<(), SceneProblem> {
    let mut names = BTreeSet::new();
    if let Some(twice) = scene.objects.iter().find(|object| !names.insert(&object.name)) {
        let found = format!("'{}' twice", twice.name);
        return Err(SceneProblem::value("[[object]]", "a name of its own for every one", found));
    }
    let Picture { width, height, samples, .. } = scene.picture;
    // A direction drawn from every light, and one from the material.
    let pairs = width * height * samples * (scene.lamps.len() + 1);
    if pairs > MAX_PAIRS {
        let most = format!("width × height × samples × (lights + 1) of {MAX_PAIRS} at most");
        return Err(SceneProblem::value("[image]", most, pairs));
    }
    Ok(())
}

fn picture(keys: &ImageKeys) -> Result<Picture, SceneProblem> {
    let count = |place: &str, value: i64, most: usize| {
        let counted = usize::try_from(value).ok().filter(|v| (1..=most).contains(v));
        counted.ok_or_else(|| SceneProblem::value(format!("image.{place}"), format!("1 to {most}"), value))
    };
    Ok(Picture {
        width: count("width", keys.width, MAX_SIDE)?,
        height: count("height", keys.height, MAX_SIDE)?,
        samples: count("samples", keys.samples, 4096)?,
        exposure: within("image.exposure", keys.exposure, -20.0, 20.0)?,
    })
}

fn seen_from(keys: &CameraKeys) -> Result<Camera, SceneProblem> {
    let camera = Camera {
        from: place("camera.from", keys.from)?,
        to: place("camera.to", keys.to)?,
        up: place("camera.up", keys.up)?,
        field: within("camera.field", keys.field, 0.01, 170.0)?.to_radians(),
    };
    let forward = (camera.to - camera.from).normalize_or_zero();
    if forward.cross(camera.up.normalize_or_zero()).length() < 1e-6 {
        return Err(SceneProblem::value("camera", "a view that is not along `up`, to another place", "one that is"));
    }
    Ok(camera)
}

fn lamp(keys: &LightKeys, folder: &Path, name: &str) -> Result<Lamp, SceneProblem> {
    Ok(match keys {
        LightKeys::Point { at, intensity } => Lamp::Point {
            at: place(&format!("{name}, at"), *at)?,
            intensity: bright(&format!("{name}, intensity"), *intensity)?,
        },
        LightKeys::Area { centre, u, v, radiance } => {
            let (centre, u, v) = rectangle(name, *centre, *u, *v)?;
            Lamp::Area { centre, u, v, radiance: bright(&format!("{name}, radiance"), *radiance)? }
        }
        LightKeys::Environment { map, rotate, strength, seen } => {
            let map = match Environment::by_name(map) {
                Some(built_in) => built_in,
                None => Environment::load(&folder.join(map))?,
            };
            let rotate = within(&format!("{name}, rotate"), *rotate, -360.0, 360.0)?;
            Lamp::Environment {
                map: Box::new(map.rotated(rotate.to_radians())),
                strength: within(&format!("{name}, strength"), *strength, 0.0, 1e6)?,
                is_seen: *seen,
            }
        }
    })
}

fn object(
    keys: &ObjectKeys,
    folder: &Path,
    number: &str,
    path: &Path,
    meshes: &mut Meshes,
) -> Result<Object, SceneError> {
    let of = |problem: SceneProblem| problem.of(path);
    let name = keys.name.clone().unwrap_or_else(|| keys.material.clone());
    if name.is_empty() || name.len() > 128 || name.chars().any(char::is_control) {
        return Err(of(SceneProblem::value(number, "a printable name of 1 to 128 bytes", format!("{name:?}"))));
    }
    let number = format!("{number} ('{name}')");
    let shape = match (&keys.sphere, &keys.plane, &keys.rectangle, &keys.mesh) {
        (Some(SphereKeys { centre, radius }), None, None, None) => Shape::Sphere {
            centre: place(&format!("{number}, sphere.centre"), *centre).map_err(of)?,
            radius: within(&format!("{number}, sphere.radius"), *radius, SMALLEST, LARGEST).map_err(of)?,
        },
        (None, Some(PlaneKeys { point, normal }), None, None) => Shape::Plane {
            point: place(&format!("{number}, plane.point"), *point).map_err(of)?,
            normal: unit(&format!("{number}, plane.normal"), *normal).map_err(of)?,
        },
        (None, None, Some(RectangleKeys { centre, u, v }), None) => {
            let (centre, u, v) = rectangle(&number, *centre, *u, *v).map_err(of)?;
            Shape::Rectangle { centre, u, v }
        }
        (None, None, None, Some(MeshKeys { file, scale, at })) => {
            let scale = within(&format!("{number}, mesh.scale"), *scale, SMALLEST, LARGEST).map_err(of)?;
            let at = place(&format!("{number}, mesh.at"), *at).map_err(of)?;
            Shape::Mesh(meshes.load(&folder.join(file), scale, at)?)
        }
        _ => return Err(of(SceneProblem::value(number, "one of sphere, plane, rectangle, mesh", "none or several"))),
    };
    Ok(Object { name, material: keys.material.clone(), folder: folder.to_owned(), shape })
}
