//! The program as its users meet it: what goes in, what comes out, and with which exit code.

#[path = "cli/blend.rs"]
mod blend;
#[path = "cli/chart.rs"]
mod chart;
#[path = "cli/codes.rs"]
mod codes;
#[path = "cli/completions.rs"]
mod completions;
#[path = "cli/determinism.rs"]
mod determinism;
#[path = "cli/export.rs"]
mod export;
#[path = "cli/guided.rs"]
mod guided;
#[cfg(unix)]
#[path = "cli/killed.rs"]
mod killed;
#[path = "cli/learn.rs"]
mod learn;
#[path = "cli/linear.rs"]
mod linear;
#[path = "cli/listed.rs"]
mod listed;
#[path = "cli/manifold.rs"]
mod manifold;
#[path = "cli/measured.rs"]
mod measured;
#[path = "cli/networks.rs"]
mod networks;
#[path = "cli/plan.rs"]
mod plan;
#[path = "cli/reconstruct.rs"]
mod reconstruct;
#[cfg(target_os = "linux")]
#[path = "cli/refused.rs"]
mod refused;
#[path = "cli/render.rs"]
mod render;
#[path = "cli/stress.rs"]
mod stress;
mod support;
#[path = "cli/together.rs"]
mod together;

use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::npy;
use support::Place;

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

/// A folder `two` of two networks, both held out.
fn two_materials(place: &Place) {
    place.library("two", ["chrome", "blue-fabric"]);
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
    place.run_with_input(&["decode", "-", "-o", "x.gif"], b"").fails(2);
    assert!(place.names().is_empty());
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
