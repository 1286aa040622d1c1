//! Sessions of earlier versions, which knew maps and meshes by their places in a list.

use std::path::Path;

use nbrdf_core::scene::Mesh;
use serde_json::{Value, json};

/// Endings of environment maps.
const MAPS: [&str; 2] = ["hdr", "exr"];

/// Puts the file of a map or a mesh in the place of its number: the built-in one was 0, the others followed in the order in
/// which their files were opened. A number that means none of these files is left to be read as the built-in one.
pub fn renew(session: &mut Value) {
    let files: Vec<String> = session["files"]
        .as_array()
        .map_or_else(Vec::new, |files| files.iter().filter_map(|file| file.as_str().map(str::to_owned)).collect());
    for (place, endings) in
        [("/look/scenery/lighting/Around/map", MAPS.as_slice()), ("/look/scenery/shape/Mesh", Mesh::ENDINGS.as_slice())]
    {
        let Some(found) = session.pointer_mut(place) else { continue };
        let number = found.as_u64().and_then(|number| usize::try_from(number).ok());
        let Some(number) = number.and_then(|number| number.checked_sub(1)) else { continue };
        let mut own = files.iter().filter(|file| is_one_of(file, endings));
        if let Some(file) = own.nth(number) {
            *found = json!({ "file": file });
        }
    }
}

fn is_one_of(file: &str, endings: &[&str]) -> bool {
    let ending = Path::new(file).extension();
    ending.is_some_and(|ending| endings.iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use crate::worker::{Asset, Lighting, Shape};

    #[test]
    fn places_of_an_earlier_session_become_the_files_that_were_there() {
        let of = |map: usize, mesh: usize| {
            let text = format!(
                r#"{{"schema": 1, "session": {{
                    "files": ["/a/ours.npz", "/a/room.exr", "/a/pot.obj", "/a/street.HDR"],
                    "look": {{"scenery": {{"lighting": {{"Around": {{"map": {map}, "turn": 0.5}}}}, "shape": {{"Mesh": {mesh}}}}}}}
                }}}}"#
            );
            let scenery = parse(text.as_bytes()).unwrap().session.look.scenery;
            let Lighting::Around { map, .. } = scenery.lighting else { panic!("{scenery:?}") };
            let Shape::Mesh(mesh) = scenery.shape else { panic!("{scenery:?}") };
            [map, mesh]
        };
        let file = |path: &str| Asset::of_file(path.as_ref());
        assert_eq!(of(2, 1), [file("/a/street.HDR"), file("/a/pot.obj")]);
        assert_eq!(of(1, 0), [file("/a/room.exr"), Asset::BuiltIn]);
        assert_eq!(of(0, 7), [Asset::BuiltIn; 2], "what nobody knows is the built-in one");
    }
}
