//! Walks between materials, drawn.

use super::support::Place;

#[test]
fn a_blend_of_many_materials_follows_a_spline_and_tells_distances() {
    let place = Place::new();
    let arguments =
        ["blend", "chrome", "red-fabric", "gold-paint", "--steps", "5", "--method", "latent", "--method", "linear_mix"];
    let report = place.run(&[&arguments[..], &["--size", "32", "--json"]].concat()).json();
    assert_eq!(report["weights"].as_array().unwrap().len(), 5);
    assert_eq!(report["methods"][0]["distances"].as_array().unwrap().len(), 5);
    assert!(report["methods"][1]["distances"].is_null());
    assert!(report["methods"].as_array().unwrap().iter().all(|walk| walk["reciprocity"].as_f64().unwrap() < 0.2));
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
