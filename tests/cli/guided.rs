//! What a newcomer types, and where the program leads.

use nbrdf_core::measured;
use nbrdf_core::nbrdf::file::Form;

use super::chrome_npz;
use super::support::Place;

#[test]
fn a_file_that_is_missing_is_told_in_one_way_whoever_asks_for_it() {
    let place = Place::new();
    for (arguments, file) in [
        (&["info"][..], "none.npz"),
        (&["info"], "none.binary"),
        (&["info"], "none.json"),
        (&["info"], "none.foo"),
        (&["info"], "./none"),
        (&["info"], "no/such/place"),
        (&["decode", "-o", "x.npz"], "none.json"),
        (&["decode", "-o", "x.npz"], "none"),
        (&["edit", "--json"], "none.json"),
        (&["fit", "-o", "x.npz"], "none.csv"),
        (&["fit", "-o", "x.npz"], "none"),
        (&["import", "-o", "library"], "none.zip"),
        (&["import", "-o", "library"], "none"),
        (&["plan"], "none.toml"),
        (&["info", "chrome", "--library"], "none"),
        (&["info", "chrome", "--checkpoint"], "none.safetensors"),
        (&["evaluate", "--reference"], "none.zip"),
        (&["learn", "pca_45", "-o", "x.safetensors", "--library"], "none"),
        (&["train", "-o", "x.safetensors", "--library"], "none"),
        (&["chart", "--from"], "none.json"),
        (&["stress", "--from"], "none.json"),
        (&["render", "chrome", "-o", "x.png", "--environment"], "none.exr"),
        (&["export", "--to", "npz", "-o", "x"], "none.h5"),
    ] {
        let edit: &[&str] = if arguments[0] == "edit" { &["gloss+0.1"] } else { &[] };
        let said = place.run(&[arguments, &[file], edit].concat()).fails(3);
        let line = said.lines().find(|line| line.starts_with("error: ")).unwrap_or_default();
        assert!(line.starts_with(&format!("error: {file}: expected ")), "{arguments:?}: {said}");
        assert!(line.contains(", found no such file: check the path"), "{arguments:?}: {said}");
        assert!(!said.contains("os error"), "{arguments:?}: {said}");
    }
    assert!(place.names().is_empty(), "{:?}", place.names());
}

#[test]
fn a_word_that_is_no_material_brings_those_that_may_be_meant() {
    let place = Place::new();
    for (word, meant) in [("gold", "`gold-paint`"), ("merl/chrome", "`chrome`"), ("Chrome-Steel2", "`chrome-steel`")] {
        let said = place.run(&["info", word]).fails(2);
        assert!(said.contains(&format!("no material `{word}`")) && said.contains(meant), "{said}");
    }
    let said = place.run(&["info", "chrome.foo"]).fails(3);
    assert!(said.contains("no such file") && said.contains("such as `chrome`"), "{said}");
}

#[test]
fn a_material_where_a_code_or_a_measurement_is_expected_brings_the_command_to_use() {
    let place = Place::new();
    place.write("chrome.npz", &chrome_npz());
    for (arguments, said) in [
        (&["decode", "chrome", "-o", "x.npz"][..], "`nbrdf encode chrome` makes its code"),
        (&["fit", "chrome", "-o", "x.npz"], "nothing to fit"),
        (&["encode", "-"], "`nbrdf decode - -o OUT.npz` makes a network of it"),
        (&["render", "chrome", "-o", "x.png", "--light", "softboxes"], "nbrdf render --environment softboxes"),
        (&["blend", "chrome", "brass", "--light", "softboxes"], "nbrdf render --environment softboxes"),
        (&["encode", "chrome", "--with", "foo"], "factored_microfacet"),
    ] {
        let found = place.run(arguments).fails(2);
        assert!(found.contains(said), "{arguments:?}: {found}");
    }
    let said = place.run(&["encode", "chrome", "--with", "foo"]).fails(2);
    assert!(!said.contains("similar"), "nothing is near foo: {said}");
    // A file goes before the advice.
    place.run(&["encode", "chrome", "-o", "chrome"]).fails(2);
    std::fs::copy(place.path().join("chrome.npz"), place.path().join("chrome")).unwrap();
    assert!(place.run(&["decode", "chrome", "-o", "x.npz"]).fails(3).contains("chrome: expected a code"));
    assert_eq!(place.names(), ["chrome", "chrome.npz"]);
}

#[test]
fn a_file_of_an_unknown_kind_brings_every_form_that_is_read() {
    let place = Place::new();
    place.write("notes.txt", b"hello");
    let said = place.run(&["info", "notes.txt"]).fails(3);
    for extension in Form::EXTENSIONS.iter().chain(&measured::EXTENSIONS).chain(&["json", "zip"]) {
        assert!(said.contains(&format!(".{extension}")), "{extension}: {said}");
    }
    for extension in measured::EXTENSIONS {
        assert!(place.run(&["fit", "notes.txt", "-o", "x.npz"]).fails(3).contains(&format!(".{extension}")));
    }
    for extension in Form::EXTENSIONS {
        assert!(place.run(&["import", "notes.txt", "-o", "l"]).fails(3).contains(&format!(".{extension}")));
    }
}

#[test]
fn an_import_replaces_a_library_and_nothing_else() {
    let place = Place::new();
    place.write("a.npz", &chrome_npz());
    std::fs::create_dir(place.path().join("page")).unwrap();
    let foreign = br#"{"name": "a web page", "start_url": "/"}"#;
    place.write("page/manifest.json", foreign);
    let said = place.run(&["import", "a.npz", "-o", "page"]).fails(3);
    assert!(said.contains("page: expected no manifest.json") && said.contains("name another folder"), "{said}");
    assert_eq!(place.file("page/manifest.json"), foreign);
    place.write("page/library.safetensors", b"weights of another program");
    place.run(&["import", "a.npz", "-o", "page", "--shared-start"]).fails(3);
    assert_eq!(place.file("page/manifest.json"), foreign);
    assert_eq!(place.file("page/library.safetensors"), b"weights of another program");
    for _ in 0..2 {
        place.run(&["import", "a.npz", "-o", "library"]).ok();
    }
}

#[test]
fn a_place_on_a_path_is_called_what_it_was_asked_for_as() {
    let place = Place::new();
    let at =
        ["blend", "chrome", "brass", "--method", "latent", "--size", "32", "-o", "b.png", "--code", "b.json", "--at"];
    for (asked, named) in [("0.125", "0.125"), ("0.0625", "0.0625"), ("1,3", "1 : 3")] {
        place.run(&[&at[..], &[asked]].concat()).ok();
        let code: serde_json::Value = serde_json::from_slice(&place.file("b.json")).unwrap();
        assert_eq!(code["material"], format!("chrome to brass at {named}"));
    }
}

#[cfg(feature = "gui")]
#[test]
fn a_picture_of_the_window_that_cannot_be_written_is_refused_before_the_window_opens() {
    let place = Place::new();
    for switch in ["--screenshot", "--report"] {
        let said = place.run(&["app", switch, "nowhere/x"]).fails(3);
        assert!(said.contains("nowhere/x: cannot be written"), "{said}");
    }
}
