//! Materials in the forms that other programs read, and what is told of them.

use nbrdf_core::Library;
use nbrdf_core::hash::sha256;
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::file;
use serde_json::Value;

use super::support::Place;

fn manifest(place: &Place, name: &str) -> Value {
    serde_json::from_slice(&place.file(name)).unwrap()
}

#[test]
fn every_form_of_a_network_keeps_its_weights_and_has_a_manifest() {
    let place = Place::new();
    let chrome = &builtin::shared().get("chrome").unwrap().network;
    for (form, read) in [("npz", "c.npz"), ("safetensors", "c.safetensors"), ("npy", "c_b2.npy"), ("keras", "c.h5")] {
        let report = place.run(&["export", "chrome", "--to", form, "-o", "c", "--json"]).json();
        assert_eq!(file::read(&place.path().join(read)).unwrap().weights(), chrome.weights(), "{form}");
        let told = &report["exports"][0];
        assert_eq!((&told["error"]["log_error"], &told["error"]["image_mean_error"]), (&0.0.into(), &0.0.into()));
        let manifest = manifest(&place, told["manifest"].as_str().unwrap());
        assert_eq!((&manifest["material"], &manifest["form"]), (&"chrome".into(), &form.into()));
        assert!(manifest["convention"].as_str().unwrap().contains("without the cosine"), "{manifest}");
        for file in manifest["files"].as_array().unwrap() {
            assert_eq!(file["sha256"], sha256(&place.file(file["name"].as_str().unwrap())), "{file}");
        }
    }
}

#[test]
fn tables_are_read_again_within_a_percent_and_codes_keep_their_source() {
    let place = Place::new();
    place.run(&["encode", "red-fabric", "-o", "code.json"]).ok();
    place.run(&["export", "code.json", "-o", "r.bsdf"]).ok();
    let told = manifest(&place, "r.bsdf.manifest.json");
    assert!(told["error"]["image_mean_error"].as_f64().unwrap() < 0.01, "{told}");
    assert!(told["error"]["studio_psnr"].as_f64().unwrap() > 50.0, "{told}");
    assert_eq!(told["code"]["code"].as_array().unwrap().len(), 32);
    assert_eq!(told["checkpoint"], told["code"]["checkpoint"]);
    let scene = String::from_utf8(place.file("r.xml")).unwrap();
    assert!(scene.contains("value=\"r.bsdf\""), "{scene}");
    place.run(&["render", "r.bsdf", "-o", "r.exr", "--size", "32"]).ok();
}

#[test]
fn the_command_in_a_manifest_makes_the_files_again() {
    let place = Place::new();
    place.library("own", ["chrome"]);
    place.run(&["encode", "chrome", "-o", "a code.json"]).ok();
    place.run(&["export", "a code.json", "-o", "c.npz"]).ok();
    place.run(&["export", "chrome", "--library", "own", "--to", "npz", "-o", "n"]).ok();
    for (stem, command) in [
        ("c", "nbrdf export 'a code.json' --to npz -o c.npz"),
        ("n", "nbrdf export chrome --to npz -o n.npz --library own"),
    ] {
        assert_eq!(manifest(&place, &format!("{stem}.npz.manifest.json"))["command"], command);
        let before = place.file(&format!("{stem}.npz"));
        let words = command.replace("'a code.json'", "a_code.json");
        std::fs::copy(place.path().join("a code.json"), place.path().join("a_code.json")).unwrap();
        place.run(&words.split(' ').skip(1).collect::<Vec<_>>()).ok();
        assert_eq!(place.file(&format!("{stem}.npz")), before);
    }
}

#[test]
fn several_materials_go_into_a_folder_or_are_only_measured() {
    let place = Place::new();
    let report = place.run(&["export", "chrome", "rgl/paper_white", "--to", "npz", "-o", "out", "--json"]).json();
    assert_eq!(report["exports"].as_array().unwrap().len(), 2);
    assert!(Library::load(&place.path().join("out/rgl_paper_white.npz")).is_ok());
    let before = place.names();
    let report = place.run(&["export", "chrome", "brass", "--to", "keras", "--measure", "--json"]).json();
    assert_eq!(report["exports"][1]["error"]["studio_psnr"], 100.0);
    assert_eq!(place.names(), before);
    let forms = place.run(&["export", "--list", "--json"]).json();
    assert!(forms["forms"].as_array().unwrap().iter().any(|form| form["name"] == "bsdf"));
}

#[test]
fn what_cannot_be_exported_is_refused_and_leaves_nothing() {
    let place = Place::new();
    place.run(&["encode", "chrome", "-o", "c.json"]).ok();
    place.run(&["encode", "brass", "-o", "d.json"]).ok();
    let code = place.file("d.json");
    for (arguments, said) in [
        (&["export", "chrome", "-o", "x"][..], "expected a form"),
        (&["export", "chrome", "--to", "gif", "-o", "x"], "invalid value 'gif'"),
        (&["export", "chrome", "--to", "npz", "-o", "x.bsdf"], "extension .npz"),
        (&["export", "chrome", "--to", "gltf", "-o", "x.glb"], "extension .gltf of gltf or none, found .glb"),
        (&["export", "chrome", "brass", "--to", "npz", "-o", "two.npz"], "--to npz -o two/"),
        (&["export", "chrome", "brass", "-o", "two.npz"], "--to npz -o two/"),
        (&["export", "chrome", "--to", "code", "-o", "x.json"], "has no code"),
        (&["export", "c.json", "--to", "code", "-o", "c.json"], "is read"),
        (&["export", "c.json", "--to", "keras", "-o", "c.h5"], "is read"),
        (&["decode", "c.json", "-o", "c.h5"], "is read"),
        (&["export", "chrome", "--to", "keras", "-o", "d.h5"], "is not as an export left it"),
        (&["decode", "c.json", "-o", "d.h5"], "is not as an export left it"),
        (&["export", "chrme", "--to", "npz", "-o", "x"], "did you mean"),
        (&["export", "brass", "chrme", "--to", "npz", "-o", "out"], "did you mean"),
        (&["export", "c.json", "brass", "--to", "code", "-o", "out"], "has no code"),
    ] {
        let found = place.run(arguments).fails(2);
        assert!(found.contains(said), "{arguments:?}: {found}");
    }
    place.run(&["export", "missing.npz", "--to", "npz", "-o", "x"]).fails(3);
    place.run(&["export", "chrome", "--to", "npz", "-o", "nowhere/x"]).fails(3);
    assert_eq!(place.names(), ["c.json", "d.json"]);
    assert_eq!(place.file("d.json"), code);
}

#[test]
fn files_that_come_with_another_are_replaced_only_as_an_export_left_them() {
    let place = Place::new();
    place.run(&["export", "chrome", "-o", "a.bsdf"]).ok();
    place.run(&["export", "brass", "-o", "a.bsdf"]).ok();
    let scene = [place.file("a.xml"), b"<!-- my lamp -->".to_vec()].concat();
    place.write("a.xml", &scene);
    for arguments in [&["export", "chrome", "-o", "a.bsdf"][..], &["export", "chrome", "--to", "bsdf", "-o", "a"]] {
        let said = place.run(arguments).fails(2);
        assert!(said.contains("a.xml: is there") && said.contains("move it"), "{said}");
    }
    assert_eq!(
        (place.file("a.xml"), manifest(&place, "a.bsdf.manifest.json")["material"].clone()),
        (scene, "brass".into())
    );
}

#[test]
fn what_is_read_stays_and_so_does_what_nobody_named() {
    let place = Place::new();
    place.run(&["export", "chrome", "-o", "nets.h5"]).ok();
    place.run(&["encode", "chrome", "-o", "c.json"]).ok();
    let said = place.run(&["export", "nets", "--library", "nets.h5", "-o", "nets.h5"]).fails(2);
    assert!(said.contains("nets.h5: is read"), "{said}");
    place.run(&["export", "chrome", "brass", "--to", "npz", "-o", "fits"]).ok();
    place.run(&["export", "chrome", "brass", "--to", "npz", "-o", "fits"]).ok();
    place.write("fits/brass.npz", b"my fit");
    let said = place.run(&["export", "chrome", "brass", "--to", "npz", "-o", "fits"]).fails(2);
    assert!(said.contains("brass.npz: is there"), "{said}");
    assert_eq!(place.file("fits/brass.npz"), b"my fit");
    place.run(&["export", "chrome", "brass", "--to", "npz", "--measure"]).ok();
}

#[test]
fn a_name_with_a_dot_keeps_it_before_the_extension() {
    let place = Place::new();
    place.run(&["export", "chrome", "-o", "v1.chrome.npz"]).ok();
    assert_eq!(place.names(), ["v1.chrome.npz", "v1.chrome.npz.manifest.json"]);
    let command = manifest(&place, "v1.chrome.npz.manifest.json")["command"].as_str().unwrap().to_owned();
    place.run(&command.split(' ').skip(1).collect::<Vec<_>>()).ok();
    assert_eq!(place.names().len(), 2, "{command}");
}

#[test]
fn sizes_that_are_listed_are_those_of_files() {
    let place = Place::new();
    let text = place.run(&["export", "white-fabric", "--to", "binary", "-o", "t"]).text();
    let length = |name: &str| place.file(name).len() as f64 / 1e6;
    assert!(text.contains(&format!(", {:.1} MB; ", length("t.binary"))), "{text}");
    place.run(&["export", "white-fabric", "--to", "bsdf", "-o", "t"]).ok();
    let list = place.run(&["export", "--list"]).text();
    // A smooth material takes the smallest table.
    for size in [format!("MERL database, {:.0} MB", length("t.binary")), format!(" {:.1} to ", length("t.bsdf"))] {
        assert!(list.contains(&size), "{size}: {list}");
    }
}

#[test]
fn programs_are_read_for_their_numbers_which_are_those_of_the_network() {
    let place = Place::new();
    for form in ["glsl", "hlsl", "wgsl", "c", "rs", "html"] {
        place.run(&["export", "chrome", "--to", form, "-o", "chrome"]).ok();
        let error = &manifest(&place, &format!("chrome.{form}.manifest.json"))["error"];
        assert_eq!((&error["log_error"], &error["image_pixel_error"]), (&0.0.into(), &0.0.into()), "{form}");
    }
}
