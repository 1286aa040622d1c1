//! Two programs at once, writing to one place: one of them has the last word, and its result is whole.

use std::collections::BTreeMap;
use std::path::Path;

use super::support::Place;

/// Rounds of each pair.
const ROUNDS: usize = 10;

/// Files by name, those of temporary names left out.
fn files(path: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(path).into_iter().flatten().map(|entry| entry.unwrap().path());
    let visible = entries.filter(|path| !path.file_name().unwrap().to_str().unwrap().starts_with('.'));
    visible
        .map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), std::fs::read(&path).unwrap()))
        .collect()
}

/// Runs both commands alone, then together, again and again; they write into the folder `out`.
fn race(place: &Place, commands: [&[&str]; 2]) {
    let out = place.path().join("out");
    let anew = || {
        let _ = std::fs::remove_dir_all(&out);
        std::fs::create_dir(&out).unwrap();
    };
    let alone = commands.map(|command| {
        anew();
        place.run(command).ok();
        files(&out)
    });
    assert_ne!(alone[0], alone[1]);
    let mut firsts = 0;
    for round in 0..ROUNDS {
        if round % 2 == 0 {
            anew();
        }
        let [a, b] = commands.map(|command| place.start(command));
        for mut child in [a, b] {
            assert!(child.wait().unwrap().success(), "{commands:?}");
        }
        let found = files(&out);
        assert!(alone.contains(&found), "{commands:?}: of both, {:?}", found.keys());
        firsts += usize::from(found == alone[0]);
        let hidden = std::fs::read_dir(&out).unwrap().count() - found.len();
        assert_eq!(hidden, 0, "nothing temporary is left");
    }
    println!("{commands:?}: the first had the last word in {firsts} of {ROUNDS}");
}

#[test]
fn two_imports_into_one_library_leave_one_of_them() {
    let place = Place::new();
    place.library("a", ["chrome", "brass"]);
    place.library("b", ["gold-paint", "blue-fabric", "pink-felt"]);
    race(&place, [&["import", "a", "-o", "out", "--quiet"], &["import", "b", "-o", "out", "--quiet"]]);
}

#[test]
fn two_fits_to_one_set_of_files_leave_one_of_them() {
    let place = Place::new();
    place.write("a.csv", super::SAMPLES.as_bytes());
    let fit = |steps: &'static str, output: &'static str| ["fit", "a.csv", "-o", output, "--steps", steps, "--quiet"];
    race(&place, [&fit("20", "out/a.npy"), &fit("21", "out/a.npy")]);
    race(&place, [&fit("20", "out/a.npz"), &fit("21", "out/a.npz")]);
}

#[test]
fn two_trainings_to_one_checkpoint_leave_one_of_them() {
    let train = |steps: &'static str| {
        ["train", "--architecture", "published", "--steps", steps, "-o", "out/a.safetensors", "--quiet"]
    };
    race(&Place::new(), [&train("3"), &train("4")]);
}

#[test]
fn two_learnings_renderings_or_encodings_leave_one_of_them() {
    let learn =
        |count: &'static str| ["learn", "pca_weights", "--numbers", count, "-o", "out/a.safetensors", "--quiet"];
    race(&Place::new(), [&learn("3"), &learn("4")]);
    let render = |name: &'static str| ["render", name, "-o", "out/a.exr", "--size", "64", "--quiet"];
    race(&Place::new(), [&render("chrome"), &render("brass")]);
    let encode = |name: &'static str| ["encode", name, "-o", "out/a.json", "--quiet"];
    race(&Place::new(), [&encode("chrome"), &encode("brass")]);
}

#[test]
fn two_exports_into_one_folder_leave_one_of_them() {
    let place = Place::new();
    place.write("scene.toml", super::SCENE.as_bytes());
    let plan = |tolerance: &'static str, picture: &'static str| {
        ["plan", "scene.toml", "--by", "bytes", "--tolerance", tolerance, "--export", "out", "-o", picture, "--quiet"]
    };
    race(&place, [&plan("1", "a.png"), &plan("0.02", "b.png")]);
}
