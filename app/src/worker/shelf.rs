//! The thread that renders thumbnails and reads files.

use std::path::{Path, PathBuf};
use std::sync::{PoisonError, mpsc};

use nbrdf_core::render::{Environment, Light, Sphere};
use nbrdf_core::{Library, Material};

use super::{Answer, Map, Office, guarded, picture::Picture};
use crate::measure::guard;

/// Side of a thumbnail in pixels: 44 points on a dense display.
const SIZE: usize = 88;

/// Thumbnails first, then files as they come.
pub(super) fn run(office: &Office, files: &mpsc::Receiver<PathBuf>) {
    let sphere = Sphere::new(SIZE, &Light::studio());
    thumbnails(office, &sphere, &office.stock.materials);
    for path in files {
        if is_map(&path) {
            match guarded("Reading the map", || Environment::load(&path).map_err(|error| error.to_string())) {
                Ok(Ok(environment)) => {
                    let (names, place) =
                        office.surround_with(Map { name: name_of(&path), file: Some(path), environment });
                    office.say(Answer::Surround(names, place));
                }
                Ok(Err(why)) | Err(why) => office.say(Answer::Notice(why)),
            }
            continue;
        }
        match guarded("Reading the file", || read(office, &path)) {
            Ok(Ok(materials)) => {
                let names = materials.iter().map(|material| material.name.clone()).collect();
                office.materials.write().unwrap_or_else(PoisonError::into_inner).extend(materials.iter().cloned());
                office.say(Answer::Opened(names));
                thumbnails(office, &sphere, &materials);
                warn(office, &materials);
            }
            Ok(Err(why)) | Err(why) => office.say(Answer::Notice(why)),
        }
    }
}

fn thumbnails(office: &Office, sphere: &Sphere, materials: &[Material]) {
    for Material { name, brdf, .. } in materials {
        match guarded(name, || Picture::of(&sphere.render(brdf.as_ref()), 0.0, &office.plates)) {
            Ok(picture) => office.say(Answer::Thumbnail(name.clone(), picture)),
            Err(why) => office.say(Answer::Notice(why)),
        }
    }
}

/// What is odd about materials that were opened.
fn warn(office: &Office, materials: &[Material]) {
    for Material { name, brdf, .. } in materials {
        let brdf = brdf.as_ref();
        let said = || guard::of_result(brdf).chain(guard::of_source(brdf)).collect();
        let warnings: Vec<_> = guarded(name, said).unwrap_or_default();
        warnings.into_iter().for_each(|warning| office.say(Answer::Notice(format!("{name}: {warning}"))));
    }
}

/// An environment map, by its extension.
fn is_map(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    ["hdr", "exr"].iter().any(|map| extension.eq_ignore_ascii_case(map))
}

fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}

fn read(office: &Office, path: &Path) -> Result<Vec<Material>, String> {
    let mut materials = Library::load(path).map_err(|error| error.to_string())?.materials();
    let stem = name_of(path);
    for material in &mut materials {
        // Two files may hold a material of one name; both stay.
        let (name, mut copy) = (material.name.clone(), 1);
        while office.material(&material.name).is_some() {
            material.name = if copy == 1 { format!("{name} ({stem})") } else { format!("{name} ({stem} {copy})") };
            copy += 1;
        }
    }
    Ok(materials)
}
