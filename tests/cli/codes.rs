//! Codes: made, edited, read back, refused.

use nbrdf_core::hash::sha256;
use nbrdf_core::nbrdf::ARRAYS;
use serde_json::Value;

use super::support::Place;

#[test]
fn a_code_goes_through_a_pipe_and_comes_back_as_a_network() {
    let place = Place::new();
    let code = place.run(&["encode", "chrome"]).ok();
    let parsed: Value = serde_json::from_slice(&code).unwrap();
    assert_eq!((&parsed["schema"], &parsed["material"]), (&1.into(), &"chrome".into()));
    assert_eq!(parsed["code"].as_array().unwrap().len(), 32);
    for name in ["c.npz", "c.safetensors", "c.npy"] {
        place.run_with_input(&["decode", "-", "-o", name], &code).ok();
    }
    let manifests = 3;
    assert_eq!(place.names().len(), 2 + ARRAYS.len() + manifests);
    assert_eq!(place.run(&["info", "c.npz", "--json"]).json()["hidden"], serde_json::json!([21, 21]));
    place.run(&["encode", "c_fc1.npy", "-o", "again.json"]).ok();
    assert_eq!(place.run_with_input(&["info", "-", "--json"], &code).json()["name"], "chrome");
}

#[test]
fn what_is_decoded_has_a_manifest_with_the_command_that_makes_it_again() {
    let place = Place::new();
    place.run(&["encode", "gold-paint", "-o", "g.json"]).ok();
    let report = place.run(&["decode", "g.json", "-o", "g.npz", "--json"]).json();
    assert_eq!(report["manifest"], "g.npz.manifest.json");
    let manifest: Value = serde_json::from_slice(&place.file("g.npz.manifest.json")).unwrap();
    assert_eq!((&manifest["form"], &manifest["error"]["log_error"]), (&"npz".into(), &0.0.into()));
    assert_eq!(manifest["code"]["code"].as_array().unwrap().len(), 32);
    assert_eq!(manifest["files"][0]["sha256"], sha256(&place.file("g.npz")));
    let (before, command) = (place.file("g.npz"), manifest["command"].as_str().unwrap());
    assert_eq!(command, "nbrdf decode g.json -o g.npz");
    place.run(&command.split(' ').skip(1).collect::<Vec<_>>()).ok();
    assert_eq!(place.file("g.npz"), before);
    // A folder of networks with their manifests is a library.
    place.run(&["import", ".", "-o", "library"]).ok();
}

#[test]
fn the_help_of_decode_names_every_form_that_it_writes() {
    let place = Place::new();
    let help = place.run(&["decode", "--help"]).text();
    let forms = place.run(&["export", "--list", "--json"]).json();
    for form in forms["forms"].as_array().unwrap() {
        let extension = format!(".{}", form["extension"].as_str().unwrap());
        let is_told = help.split([' ', ',', ';']).any(|word| word == extension);
        assert_eq!(is_told, form["needs"] != "code", "{extension}: {help}");
    }
    let said = place.run(&["decode", "c.json", "-o", "c.json"]).fails(2);
    assert!(said.contains(".safetensors") && !said.contains(".json or") && !said.contains("or .json"), "{said}");
}

#[test]
fn the_same_material_gives_the_same_code_and_refinement_another() {
    let place = Place::new();
    let plain = place.run(&["encode", "chrome"]).ok();
    assert_eq!(place.run(&["encode", "chrome", "--threads", "1"]).ok(), plain);
    assert_ne!(place.run(&["encode", "chrome", "--refine"]).ok(), plain);
}

#[test]
fn an_encoding_says_what_error_to_expect_and_warns_of_what_a_code_does_not_carry() {
    let place = Place::new();
    let known = place.run(&["encode", "gold-paint"]).json();
    let expected = known["expected_log_error"].as_f64().unwrap();
    assert!(expected > 0.0 && expected < 0.015, "{expected}");
    assert!(known["distance"].as_f64().unwrap() < 1.0, "gold-paint is a training material");
    let foreign = place.run(&["encode", "rgl/vch_ultra_pink"]);
    assert!(foreign.talk().contains("keep the network, or try --refine"));
    let refined = place.run(&["encode", "rgl/vch_ultra_pink", "--refine"]).talk();
    assert!(!refined.contains("--refine"), "{refined}");
    assert!(foreign.json()["expected_log_error"].as_f64().unwrap() > 0.015);
}

#[test]
fn an_edit_writes_a_code_that_is_rendered_and_refuses_what_is_no_quality() {
    let place = Place::new();
    let text = place.run(&["edit", "gold-paint", "roughness+0.05", "hue+0.1", "-o", "edited.json"]).text();
    assert!(text.contains("roughness") && text.contains("distance"), "{text}");
    let code: Value = serde_json::from_slice(&place.file("edited.json")).unwrap();
    assert_eq!(code["material"], "gold-paint roughness+0.05 hue+0.1");
    place.run(&["render", "edited.json", "-o", "edited.png", "--size", "32"]).text();
    let report = place.run(&["edit", "edited.json", "gloss-0.02", "-o", "twice.json", "--json"]).json();
    assert!(report["after"]["gloss"].as_f64().unwrap() < report["before"]["gloss"].as_f64().unwrap());
    // Further than half a turn is not short of it.
    let turned = place.run(&["edit", "gold-paint", "hue+0.6", "-o", "turned.json"]);
    assert!(!turned.talk().contains("hue"), "{}", turned.talk());
    let short = place.run(&["edit", "chrome", "metalness+0.9", "-o", "short.json"]);
    assert!(short.talk().contains("not by +0.900"), "{}", short.talk());
    for wrong in ["shine+0.1", "gloss", "gloss+2"] {
        place.run(&["edit", "gold-paint", wrong]).fails(2);
    }
    place.run(&["edit", "gold-paint", "gloss+0.1", "-o", "no/such/folder.json"]).fails(3);
}

#[test]
fn codes_of_tables_are_rendered_but_not_written_as_networks() {
    let place = Place::new();
    place.run(&["encode", "chrome", "--with", "pca_tables", "-o", "t.json"]).ok();
    let said = place.run(&["decode", "t.json", "-o", "t.npz"]).fails(2);
    assert!(said.contains("nbrdf render t.json"), "{said}");
    place.run(&["render", "t.json", "-o", "t.png", "--size", "32"]).ok();
    assert_eq!(place.names(), ["t.json", "t.png"]);
}

#[test]
fn codes_of_another_length_model_or_checkpoint_exit_with_3() {
    let place = Place::new();
    let code: Value = serde_json::from_slice(&place.run(&["encode", "chrome"]).ok()).unwrap();
    let changed = |key: &str, value: Value| {
        let mut code = code.clone();
        code[key] = value;
        code.to_string()
    };
    let cases = [
        (changed("code", serde_json::json!([1.0, 2.0])), "32 numbers, found 2"),
        (changed("checkpoint", "0123456789abcdef".into()), "0123456789abcdef"),
        (changed("model", "znbrdff".into()), "znbrdf"),
        (changed("schema", 2.into()), "schema 2"),
        (code.to_string().replacen("[", "[1e39, ", 1), "place 0"),
        ("{".into(), "nbrdf encode"),
    ];
    for (json, expected) in cases {
        let said = place.run_with_input(&["decode", "-", "-o", "x.npz"], json.as_bytes()).fails(3);
        assert!(said.contains(expected) && said.contains("standard input"), "{said}");
    }
    place.run(&["decode", "missing.json", "-o", "x.npz"]).fails(3);
    assert!(place.names().is_empty());
}

#[test]
fn codes_have_the_length_that_the_checkpoint_was_trained_for() {
    let place = Place::new();
    place.run(&["train", "--dim", "4", "--steps", "10", "-o", "four.safetensors", "--json"]).json();
    let code = place.run(&["encode", "chrome", "--checkpoint", "four.safetensors"]).json();
    assert_eq!(code["code"].as_array().unwrap().len(), 4);
    place.write("four.json", code.to_string().as_bytes());
    place.run(&["decode", "four.json", "-o", "x.npz", "--checkpoint", "four.safetensors"]).ok();
    place.run(&["decode", "four.json", "-o", "y.npz"]).fails(3);
    for refused in [&["--dim", "0"][..], &["--dim", "129"], &["--dim", "8", "--architecture", "published"]] {
        place.run(&[&["train", "-o", "z.safetensors"], refused].concat()).fails(2);
    }
    assert_eq!(place.names(), ["four.json", "four.safetensors", "x.npz", "x.npz.manifest.json"]);
}
