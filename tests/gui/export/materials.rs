//! Materials that are written, and what their manifests tell.

use std::sync::Arc;

use nbrdf::catalog::{Catalog, Reference};
use nbrdf::worker::Timing;
use nbrdf_core::library::builtin;
use nbrdf_core::path::clock::Clock;
use nbrdf_core::{Library, Weights};

use super::*;

#[test]
fn a_material_is_written_and_its_manifest_tells_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.export.card = "A".to_owned();
    let mut harness = built_in(session);
    choose(&mut harness, What::Material);
    let said = write(&mut harness);
    assert!(said.contains("out.npz") && said.contains("out.manifest.json"), "{said}");
    let read = Library::load(&folder.path().join("out.npz")).unwrap().into_entries();
    assert_eq!(read[0].network.weights(), builtin::shared().get("gold-paint").unwrap().network.weights());
    let manifest = manifest(folder.path());
    assert!(manifest["what"] == "material" && manifest["material"] == "gold-paint", "{manifest}");
    assert!(manifest["error"]["log_error"] == 0.0 && manifest["error"]["studio_psnr"] == 100.0, "{manifest}");
    assert!(manifest["convention"].as_str().unwrap().contains("without the cosine"), "{manifest}");
    harness.state_mut().session.export.card = "raw_weights".to_owned();
    harness.state_mut().session.export.name = "between".to_owned();
    harness.run_steps(2);
    looked(&mut harness);
    let said = write(&mut harness);
    assert!(said.contains("between.npz"), "{said}");
    let between = Library::load(&folder.path().join("between.npz")).unwrap().into_entries();
    assert_ne!(between[0].network.weights(), read[0].network.weights());
}

#[test]
fn all_materials_along_a_path_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built_in(writing(folder.path()));
    choose(&mut harness, What::Steps);
    write(&mut harness);
    let manifest = manifest(folder.path());
    assert_eq!(manifest["files"].as_array().unwrap().len(), 3);
    assert_eq!(manifest["methods"][0], "raw_weights");
    assert_eq!(manifest["error"].as_array().unwrap().len(), 3);
    let folder = folder.path();
    let weights = |step: usize| {
        Library::load(&folder.join(format!("out_{step:02}.npz")))
            .unwrap()
            .into_entries()
            .remove(0)
            .network
            .into_weights()
    };
    let [first, middle, last] = [0, 1, 2].map(weights);
    for ((first, last), middle) in first.iter().zip(&last).zip(&middle) {
        assert!((0.5 * (first + last) - middle).abs() < 1e-5);
    }
}

#[test]
fn of_an_even_path_between_three_the_weights_of_its_clock_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.blend.choose(2, "chrome");
    (session.blend.timing, session.blend.t) = (Timing::Even, 0.25);
    let mut harness = built_in(session);
    choose(&mut harness, What::Material);
    write(&mut harness);
    let told = manifest(folder.path());
    let ends = ["gold-paint", "blue-acrylic", "chrome"].map(|name| builtin::shared().get(name).unwrap().material());
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let path = catalog.interpolation("raw_weights").unwrap().between(&ends).unwrap();
    let at = Clock::of(path.as_ref(), 3).unwrap().set(0.25);
    assert!((at - 0.25).abs() > 1e-3, "{at}: nothing to tell apart");
    let weights: Vec<f64> = told["weights"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
    let wanted = Weights::along_spline(at, 3);
    assert_eq!(weights.len(), 3);
    assert!(weights.iter().zip(wanted.as_slice()).all(|(a, b)| (*a as f32 - b).abs() < 1e-6), "{told} {wanted:?}");
    assert_eq!(told["t"], 0.25);
}

#[test]
fn an_edited_code_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Session { methods: Methods(vec!["latent"]), ..writing(folder.path()) };
    session.blend.edits[0] = 0.25;
    let mut harness = built_in(session);
    choose(&mut harness, What::Material);
    write(&mut harness);
    let told = manifest(folder.path());
    assert_eq!(told["edits"], serde_json::json!({"lightness": 0.25}));
    assert_eq!(told["edited_code"]["code"].as_array().unwrap().len(), 32);
}
