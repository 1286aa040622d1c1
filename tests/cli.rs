//! The program as its users meet it: what goes in, what comes out, and with which exit code.

#[path = "cli/chart.rs"]
mod chart;
#[path = "cli/codes.rs"]
mod codes;
#[path = "cli/determinism.rs"]
mod determinism;
#[cfg(unix)]
#[path = "cli/killed.rs"]
mod killed;
#[path = "cli/learn.rs"]
mod learn;
#[path = "cli/linear.rs"]
mod linear;
#[path = "cli/manifold.rs"]
mod manifold;
#[path = "cli/measured.rs"]
mod measured;
#[path = "cli/plan.rs"]
mod plan;
#[path = "cli/reconstruct.rs"]
mod reconstruct;
#[cfg(target_os = "linux")]
#[path = "cli/refused.rs"]
mod refused;
#[path = "cli/stress.rs"]
mod stress;
mod support;
#[path = "cli/together.rs"]
mod together;

use std::io::{Cursor, Write};

use nbrdf_core::data::published_or_skip;
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::{ARRAYS, npy};
use nbrdf_core::render::Environment;
use nbrdf_core::{Image, Rgb};
use support::Place;
use zip::{ZipWriter, write::SimpleFileOptions};

/// Samples of a grey material.
const SAMPLES: &str = "light_x,light_y,light_z,view_x,view_y,view_z,r,g,b\n\
                       0,0,1,0,0,1,.1,.2,.3\n0.6,0,0.8,0,0.6,0.8,.1,.2,.3\n0,.8,.6,0,-.6,.8,.2,.2,.3\n";

/// A scene that is soon planned.
const SCENE: &str = "[image]\nwidth = 24\nheight = 16\nsamples = 1\n\
                     [camera]\nfrom = [0, 0.5, 6]\nto = [0, 0, 0]\nfield = 34\n\
                     [[light]]\nkind = \"environment\"\nmap = \"softboxes\"\nseen = false\n\
                     [[object]]\nname = \"a\"\nmaterial = \"red-plastic\"\n\
                     sphere = { centre = [0, 0, 0], radius = 0.9 }\n";

fn chrome_npz() -> Vec<u8> {
    npy::write_npz(&builtin::shared().get("chrome").unwrap().network)
}

fn zip_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

/// A folder `two` of two networks, both held out.
fn two_materials(place: &Place) {
    place.library("two", ["chrome", "blue-fabric"]);
}

#[test]
fn list_names_every_built_in_material_and_its_split() {
    let place = Place::new();
    let report = place.run(&["list", "--json"]).json();
    let materials = report["materials"].as_array().unwrap();
    let chrome = materials.iter().find(|material| material["name"] == "chrome").unwrap();
    assert_eq!((&chrome["database"], &chrome["held_out"]), (&"merl".into(), &true.into()));
    assert_eq!(place.run(&["list"]).text().lines().count(), materials.len());
    two_materials(&place);
    assert_eq!(place.run(&["list", "--library", "two"]).text().lines().count(), 2);
}

#[test]
fn info_tells_energy_size_and_how_well_the_model_knows_a_material() {
    let report = Place::new().run(&["info", "chrome", "--json"]).json();
    assert_eq!((&report["bytes"]["weights"], &report["bytes"]["code"]), (&2700.into(), &128.into()));
    assert!(report["live"]["multiply_adds"].as_u64().unwrap() < report["live"]["of_multiply_adds"].as_u64().unwrap());
    assert!(report["lobe"]["share"].as_f64().unwrap() > 0.5, "chrome is nearly a mirror");
    for key in ["albedo_max", "reciprocity", "negative_share"] {
        assert!(report[key].as_f64().unwrap() >= 0.0, "{key}");
    }
    assert!(report["znbrdf"]["log_error"].as_f64().unwrap() > 0.0);
    assert!(report["znbrdf"]["studio_psnr"].as_f64().unwrap() > 5.0);
    let told = |name: &str| Place::new().run(&["info", name]).text();
    assert!(told("rgl/paper_white").contains("rgl, held out"));
    assert!(told("rgl/cc_ibiza_sunset").contains("rgl, not learned from"));
    assert!(told("gold-paint").contains("merl, learned from"));
}

#[test]
fn a_blend_of_many_materials_follows_a_spline_and_tells_distances() {
    let place = Place::new();
    let arguments =
        ["blend", "chrome", "red-fabric", "gold-paint", "--steps", "5", "--method", "latent", "--method", "linear_mix"];
    let report = place.run(&[&arguments[..], &["--size", "32", "--json"]].concat()).json();
    assert_eq!(report["weights"].as_array().unwrap().len(), 5);
    assert_eq!(report["methods"][0]["distances"].as_array().unwrap().len(), 5);
    assert!(report["methods"][1]["distances"].is_null());
}

#[test]
fn render_writes_png_and_exr_of_names_files_and_codes() {
    let place = Place::new();
    place.write("mine.npz", &chrome_npz());
    place.run(&["encode", "chrome", "-o", "code.json"]).ok();
    for (material, output) in [("chrome", "a.png"), ("mine.npz", "b.exr"), ("code.json", "c.png")] {
        place.run(&["render", material, "-o", output, "--size", "32", "--light", "point"]).ok();
    }
    assert!(place.file("a.png").starts_with(b"\x89PNG"));
    assert!(place.file("b.exr").starts_with(b"\x76\x2f\x31\x01"));
    place.run(&["render", "chrome", "-o", "d.png", "--size", "32", "--exposure", "-2"]).ok();
    assert_ne!(place.file("d.png"), place.file("a.png"));
    for wrong in [["--size", "0"], ["--size", "4097"], ["--light", "moon"], ["--exposure", "nan"]] {
        place.run(&["render", "chrome", "-o", "e.png", wrong[0], wrong[1]]).fails(2);
    }
}

#[test]
fn an_environment_lights_the_sphere_the_same_for_the_same_seed() {
    let place = Place::new();
    Environment::softboxes().map().write_exr(&place.path().join("room.exr")).unwrap();
    let render = |output: &str, more: &[&str]| {
        let usual = ["render", "chrome", "-o", output, "--size", "32", "--samples", "4", "--json"];
        let report = place.run(&[&usual, more].concat()).json();
        (place.file(output), report)
    };
    let (picture, report) = render("a.png", &["--environment", "softboxes", "--seed", "1"]);
    let environment = &report["environment"];
    assert_eq!((&environment["map"], &environment["samples"]), (&"softboxes".into(), &4.into()));
    assert!(report["light"].is_null());
    let same = ["--environment", "room.exr", "--seed", "1", "--threads", "1"];
    assert_eq!(render("b.png", &same).0, picture);
    assert_ne!(render("c.png", &["--environment", "softboxes", "--seed", "2"]).0, picture);
    assert_ne!(render("d.png", &["--environment", "softboxes", "--seed", "1", "--rotate", "-90"]).0, picture);
}

#[test]
fn environments_that_are_none_exit_with_3_and_misused_switches_with_2() {
    let place = Place::new();
    Image::black(4, 4).write_exr(&place.path().join("square.exr")).unwrap();
    let mut map = Image::black(4, 2);
    map.pixels_mut()[5] = Rgb([0.0, f32::NAN, 0.0]);
    map.write_exr(&place.path().join("nan.exr")).unwrap();
    Environment::softboxes().map().write_exr(&place.path().join("room.exr")).unwrap();
    place.write("cut.exr", &place.file("room.exr")[..5000]);
    place.write("huge.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 32768\n");
    place.write("notes.hdr", b"hello");
    let before = place.names();
    let cases = [
        ("square.exr", "twice as wide as high"),
        ("nan.exr", "column 1, row 1"),
        ("cut.exr", "cut off"),
        ("huge.hdr", "32768 x 16384"),
        ("notes.hdr", "Radiance"),
        ("missing.hdr", "missing.hdr: "),
    ];
    for (map, expected) in cases {
        let said = place.run(&["render", "chrome", "-o", "x.png", "--environment", map]).fails(3);
        assert!(said.contains(map) && said.contains(expected), "{said}");
    }
    let lit = ["render", "chrome", "-o", "x.png", "--environment", "softboxes"];
    for wrong in [["--light", "point"], ["--samples", "0"], ["--rotate", "nan"], ["--rotate", "400"]] {
        place.run(&[&lit[..], &wrong].concat()).fails(2);
    }
    for wrong in [["--samples", "4"], ["--rotate", "4"], ["--environment", "softbox"]] {
        place.run(&[&lit[..4], &wrong].concat()).fails(2);
        place.run(&[&lit[..4], &wrong, &["--light", "point"]].concat()).fails(2);
    }
    assert_eq!(place.names(), before);
}

#[test]
fn blend_draws_every_method_unless_told_otherwise() {
    let place = Place::new();
    let report = place.run(&["blend", "aluminium", "blue-fabric", "--steps", "7", "--size", "32", "--json"]).json();
    let methods = report["methods"].as_array().unwrap();
    assert_eq!(methods.len(), nbrdf::catalog::INTERPOLATIONS.len());
    assert!(methods.iter().all(|method| method["failed"].is_null()), "{methods:?}");
    assert_eq!(report["weights"].as_array().unwrap().len(), 7);
    assert!(place.file("blend.png").starts_with(b"\x89PNG"));
}

#[test]
fn blend_takes_more_than_two_materials_and_chosen_places() {
    let place = Place::new();
    let quick = ["--method", "linear_mix", "--method", "latent", "--size", "16", "--json"];
    let run = |more: &[&str]| place.run(&[&["blend", "chrome", "rgl/paper_white"], more, &quick].concat());
    assert_eq!(run(&["blue-fabric", "-o", "three.png"]).json()["weights"].as_array().unwrap().len(), 7);
    assert_eq!(run(&["--at", "0.25", "0.5", "-o", "two.exr"]).json()["weights"][0], serde_json::json!([0.75, 0.25]));
    let beyond = run(&["--at", "1.5", "-o", "beyond.png"]);
    assert!(beyond.talk().contains("warning: 1.5: lies beyond"), "{}", beyond.talk());
    run(&["--at", "1.5", "-o", "strict.png", "--strict"]).fails(1);
    run(&["--method", "latnt"]).fails(2);
    assert_eq!(place.names(), ["beyond.png", "three.png", "two.exr"]);
    place.run(&["blend", "chrome"]).fails(2);
}

#[test]
fn completions_are_scripts() {
    for shell in ["bash", "zsh", "fish"] {
        assert!(Place::new().run(&["completions", shell]).text().contains("nbrdf"));
    }
}

#[test]
fn unknown_names_bring_the_nearest_and_exit_with_2() {
    let place = Place::new();
    let said = place.run(&["info", "chrme"]).fails(2);
    assert!(said.contains("did you mean `chrome`"), "{said}");
    let said = place.run(&["render", "paper-white", "-o", "x.png"]).fails(2);
    assert!(said.contains("`rgl/paper_white`"), "{said}");
    assert!(place.run(&["encode", "chrome", "--with", "pca_table"]).fails(2).contains("pca_tables"));
    place.run(&["frobnicate"]).fails(2);
    place.run(&["render", "chrome", "-o", "x.gif"]).fails(2);
    place.run_with_input(&["decode", "-", "-o", "x.h5"], b"").fails(2);
    assert!(place.names().is_empty());
}

#[test]
fn files_that_are_no_networks_exit_with_3_and_are_named() {
    let place = Place::new();
    let whole = chrome_npz();
    let wrong_shape = npy::write_npz(&nbrdf_core::Nbrdf::new([2, 2], vec![0.0; 29]).unwrap());
    let nan = {
        let mut arrays = npy::write_npy(&builtin::shared().get("chrome").unwrap().network);
        let end = arrays[0].len();
        arrays[0][end - 4..].copy_from_slice(&f32::NAN.to_le_bytes());
        arrays
    };
    for (array, bytes) in ARRAYS.iter().zip(&nan) {
        place.write(&format!("nan_{array}.npy"), bytes);
    }
    // One array of another shape than its neighbours.
    for (array, (own, other)) in ARRAYS.iter().zip(nan.iter().zip(npy_of(&wrong_shape))) {
        place.write(&format!("odd_{array}.npy"), if *array == "fc2" { &other } else { own });
    }
    place.write("cut.npz", &whole[..whole.len() / 2]);
    place.write("junk.h5", b"junk");
    place.write("notes.txt", b"hello");
    for name in ["cut.npz", "junk.h5", "./notes.txt", "missing.npz", "nan_fc1.npy", "odd_fc1.npy"] {
        let said = place.run(&["info", name]).fails(3);
        assert!(said.contains(name.trim_start_matches("./")), "{said}");
    }
}

fn npy_of(npz: &[u8]) -> [Vec<u8>; 6] {
    npy::write_npy(&npy::read_npz(npz).unwrap())
}

#[test]
fn hostile_archives_exit_with_3_and_write_nothing() {
    let place = Place::new();
    let network = chrome_npz();
    let whole = zip_of(&[("chrome.npz", &network)]);
    place.write("cut.zip", &whole[..whole.len() - 30]);
    place.write("traversal.zip", &zip_of(&[("../../chrome.npz", &network)]));
    place.write("bomb.zip", &zip_of(&[("chrome.h5", &vec![0; 32 << 20])]));
    place.write("empty.zip", &zip_of(&[("readme.txt", b"hello")]));
    let before = place.names();
    for name in ["cut.zip", "traversal.zip", "bomb.zip", "empty.zip"] {
        let said = place.run(&["import", name, "-o", "library"]).fails(3);
        assert!(said.contains(name), "{said}");
    }
    assert_eq!(place.names(), before);
    place.write("mixed.zip", &zip_of(&[("chrome.npz", &network), ("bad.h5", b"junk")]));
    place.run(&["import", "mixed.zip", "-o", "library"]).fails(3);
    let report = place.run(&["import", "mixed.zip", "-o", "library", "--skip-bad", "--json"]).json();
    assert_eq!(report["materials"].as_array().unwrap().len(), 1);
}

#[test]
fn what_cannot_be_written_exits_with_3_and_leaves_nothing() {
    let place = Place::new();
    std::fs::create_dir(place.path().join("taken.png")).unwrap();
    let commands: [&[&str]; 6] = [
        &["render", "chrome", "-o", "nowhere/x.png"],
        &["render", "chrome", "-o", "taken.png"],
        &["blend", "chrome", "blue-fabric", "-o", "nowhere/x.png"],
        &["encode", "chrome", "-o", "nowhere/x.json"],
        &["train", "-o", "nowhere/x.safetensors"],
        &["compare", "--pictures", "/dev/null/folder"],
    ];
    for command in commands {
        assert!(place.run(command).fails(3).contains("cannot be written"));
    }
    assert_eq!(place.names(), ["taken.png"]);
}

#[test]
fn the_published_archive_imports_as_100_materials() {
    let Some(archive) = published_or_skip("merl_nbrdf.zip") else { return };
    let place = Place::new();
    let report = place.run(&["import", archive.to_str().unwrap(), "-o", "merl", "--json"]).json();
    assert_eq!(report["materials"].as_array().unwrap().len(), 100);
    let listed = place.run(&["list", "--library", "merl", "--json"]).json();
    assert_eq!(listed["materials"].as_array().unwrap().len(), 100);
}

#[test]
fn a_shared_start_import_gives_the_same_bytes_for_the_same_seed() {
    let place = Place::new();
    two_materials(&place);
    let import = |output: &str, seed: &str| {
        place.run(&["import", "two", "-o", output, "--shared-start", "--steps", "20", "--seed", seed]).ok();
        place.file(&format!("{output}/library.safetensors"))
    };
    let first = import("a", "1");
    assert_eq!(import("b", "1"), first);
    assert_ne!(import("c", "2"), first);
}

#[test]
fn training_gives_the_same_checkpoint_for_any_number_of_threads_and_its_codes_are_told_from_others() {
    let place = Place::new();
    for (output, threads) in [("a.safetensors", "1"), ("b.safetensors", "3")] {
        let steps = ["train", "--steps", "20", "--seed", "3", "-o", output, "--threads", threads, "--json"];
        let report = place.run(&steps).json();
        assert_eq!(report["model"], "znbrdf");
    }
    assert_eq!(place.file("a.safetensors"), place.file("b.safetensors"));
    let code = place.run(&["encode", "chrome", "--checkpoint", "a.safetensors"]).ok();
    place.run_with_input(&["decode", "-", "-o", "x.npz", "--checkpoint", "b.safetensors"], &code).ok();
    place.run_with_input(&["decode", "-", "-o", "y.npz"], &code).fails(3);
    place.run(&["encode", "chrome", "--checkpoint", "x.npz"]).fails(3);
}

#[test]
fn comparing_draws_the_worst_pairs_and_names_them() {
    let place = Place::new();
    let quick = ["compare", "--method", "latent", "--method", "log_mix", "--pairs", "2", "--no-families", "--json"];
    let drawn = ["--pictures", "worst", "--worst-by", "step_ratio"];
    let report = place.run(&[&quick[..], &drawn].concat()).json();
    assert_eq!(report["methods"][0]["step_ratio"]["worst"].as_array().unwrap().len(), 2);
    for name in ["latent", "log_mix"] {
        assert!(place.file(&format!("worst/{name}.png")).starts_with(b"\x89PNG"));
    }
    place.run(&[&quick[..], &["--pictures", "worst", "--worst-by", "beauty"]].concat()).fails(2);
    place.run(&[&quick[..], &["--worst-by", "step_ratio"]].concat()).fails(2);
}

#[test]
fn a_library_without_held_out_materials_has_no_axes_to_show() {
    let place = Place::new();
    place.write("one.npz", &chrome_npz());
    place.run(&["import", "one.npz", "-o", "one"]).ok();
    let said = place.run(&["axes", "--reference", "one"]).fails(3);
    assert!(said.contains("held-out"), "{said}");
}

#[test]
fn speed_times_every_model_beside_the_plain_loop() {
    let place = Place::new();
    two_materials(&place);
    let report = place.run(&["speed", "--reference", "two", "--material", "chrome", "--json"]).json();
    let rows = report["evaluation"].as_array().unwrap();
    let ratio = |name: &str| rows.iter().find(|row| row["name"] == name).unwrap()["ratio_to_reference_loop"].as_f64();
    assert_eq!(ratio("reference_loop"), Some(1.0));
    assert!(ratio("nbrdf_portable").unwrap() > 0.0);
    let savings = report["pruning"]["materials"].as_array().unwrap();
    assert_eq!(savings.len(), 2);
    assert!(savings.iter().all(|saving| saving["multiply_adds"].as_u64().unwrap() <= 630));
    assert!(report["codes"]["decode_s"].as_f64().unwrap() > 0.0);
}

#[test]
fn sampling_compares_samplers_and_draws_a_chart() {
    let place = Place::new();
    two_materials(&place);
    let report = place.run(&["sampling", "--reference", "two", "-o", "chart.svg", "--json"]).json();
    let chrome = &report["rows"].as_array().unwrap()[1];
    assert_eq!((&chrome["name"], &chrome["held_out"]), (&"chrome".into(), &true.into()));
    let variance = |sampler: &str| chrome[sampler].as_f64().unwrap();
    assert!(variance("lobe") < 1.0 && variance("predicted") < 2.0 && variance("cosine") > 100.0, "{chrome}");
    assert!(String::from_utf8(place.file("chart.svg")).unwrap().starts_with("<svg"));
    place.run(&["sampling", "--reference", "two", "-o", "chart.gif"]).fails(2);
}

#[test]
fn a_code_is_sampled_by_the_lobe_that_it_predicts() {
    let place = Place::new();
    place.run(&["encode", "chrome", "-o", "chrome.json"]).ok();
    place.run(&["decode", "chrome.json", "-o", "decoded.npz"]).ok();
    let around = ["--environment", "softboxes", "--samples", "4", "--size", "24"];
    let cases =
        [("code", "chrome.json", "lobe"), ("fitted", "decoded.npz", "lobe"), ("cosine", "decoded.npz", "cosine")];
    let pictures = cases.map(|(name, material, sampler)| {
        let output = format!("{name}.exr");
        place.run(&[&["render", material, "-o", &output, "--sampler", sampler][..], &around].concat()).ok();
        place.file(&output)
    });
    // The same reflectance three times, and three ways to draw directions.
    let [code, fitted, cosine] = pictures;
    assert!(code != fitted && fitted != cosine && code != cosine);
    place.run(&["render", "chrome", "-o", "d.png", "--sampler", "cosine"]).fails(2);
}
