//! Plans: the smallest models that serve a scene.

use serde_json::Value;

use super::support::Place;

const HEAD: &str =
    "[image]\nwidth = 64\nheight = 40\nsamples = 4\n[camera]\nfrom = [0, 0.5, 6]\nto = [0, 0, 0]\nfield = 34\n";
const LAMPS: &str = "[[light]]\nkind = \"environment\"\nmap = \"softboxes\"\nseen = false\n\
                     [[light]]\nkind = \"area\"\ncentre = [-3, 5, 4]\nu = [1, 0, 1]\nv = [-0.5, 0.6, 0.5]\nradiance = [9, 9, 8]\n";

fn ball(name: &str, material: &str, x: f64) -> String {
    format!(
        "[[object]]\nname = \"{name}\"\nmaterial = \"{material}\"\nsphere = {{ centre = [{x}, 0, 0], radius = 0.9 }}\n"
    )
}

/// Chrome, felt, and a wall of paint behind them.
fn scene() -> String {
    let wall =
        "[[object]]\nname = \"wall\"\nmaterial = \"white-paint\"\nplane = { point = [0, 0, -3], normal = [0, 0, 1] }\n";
    format!("{HEAD}{LAMPS}{}{}{wall}", ball("shiny", "chrome", -1.1), ball("matte", "pink-felt", 1.1))
}

fn names(report: &Value, key: &str) -> Vec<String> {
    let objects = report["objects"].as_array().unwrap();
    objects.iter().map(|object| object[key].as_str().unwrap().to_owned()).collect()
}

#[test]
fn every_object_gets_a_model_within_the_tolerance_and_its_file() {
    let place = Place::new();
    place.write("scene.toml", scene().as_bytes());
    let report = place.run(&["plan", "scene.toml", "--json", "--export", "models", "--check"]).json();
    assert_eq!(names(&report, "name"), ["shiny", "matte", "wall"]);
    assert_eq!(names(&report, "material"), ["chrome", "pink-felt", "white-paint"]);
    assert_eq!(report["tolerance"], 0.04);
    for object in report["objects"].as_array().unwrap() {
        assert!(object["error"].as_f64().unwrap() <= 0.04 && object["ns"].as_f64().unwrap() > 0.0, "{object}");
    }
    assert!(report["times_faster"].as_f64().unwrap() > 1.0, "{report}");
    assert_eq!(report["check"]["agreement"], 1.0, "{}", report["check"]);
    assert!(place.file("plan.png").starts_with(b"\x89PNG"));
    let written: Value = serde_json::from_slice(&place.file("models/plan.json")).unwrap();
    assert_eq!(names(&written, "model"), names(&report, "model"));
    for file in names(&written, "file") {
        place.run(&["render", &format!("models/{file}"), "-o", "a.png", "--size", "16"]).ok();
    }
}

#[test]
fn fewest_bytes_take_no_more_bytes_than_least_time() {
    let place = Place::new();
    place.write("scene.toml", scene().as_bytes());
    let plan = |by: &str| place.run(&["plan", "scene.toml", "--json", "--by", by]).json();
    let bytes = |by: &str| plan(by)["planned"]["bytes"].as_u64().unwrap();
    assert!(bytes("bytes") <= bytes("time"));
}

#[test]
fn materials_may_be_files_beside_the_scene() {
    let place = Place::new();
    place.library("parts", ["chrome"]);
    place.write("parts/scene.toml", format!("{HEAD}{LAMPS}{}", ball("own", "chrome.npz", 0.0)).as_bytes());
    let report = place.run(&["plan", "parts/scene.toml", "--json", "--tolerance", "1"]).json();
    assert_eq!(names(&report, "material"), ["chrome"]);
    assert_eq!(names(&report, "model"), ["lambert"], "everything may be wrong");
}

#[test]
fn sweeps_tell_what_tolerance_costs_and_where_models_switch() {
    let place = Place::new();
    place.write("scene.toml", format!("{HEAD}{LAMPS}{}", ball("ball", "red-plastic", 0.0)).as_bytes());
    let report = place.run(&["plan", "scene.toml", "--json", "--sweep", "tolerance"]).json();
    let rows = report["rows"].as_array().unwrap();
    let number = |row: &Value, key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key}: {row}"));
    assert!(rows.iter().all(|row| number(row, "worst_error") <= number(row, "tolerance")), "{report}");
    let ns = |row: &Value| row["ns"].as_f64().unwrap();
    assert!(ns(&rows[rows.len() - 1]) < ns(&rows[0]));
    assert!(place.file("plan.svg").starts_with(b"<svg"));
    let report = place.run(&["plan", "scene.toml", "--json", "--sweep", "distance", "-o", "far.png"]).json();
    let rows = report["rows"].as_array().unwrap();
    assert!(rows.iter().all(|row| number(row, "error") <= 0.04), "{report}");
    assert!(report["largest_change"].as_f64().unwrap() <= 0.04, "{report}");
    assert!(place.file("far.png").starts_with(b"\x89PNG"));
}

#[test]
fn a_scene_may_come_from_a_pipe_and_an_export_replaces_that_of_before() {
    let place = Place::new();
    let text = format!("{HEAD}{LAMPS}{}", ball("own", "red-plastic", 0.0));
    for tolerance in ["1", "0.01"] {
        let arguments = ["plan", "-", "--quiet", "--tolerance", tolerance, "--export", "models"];
        place.run_with_input(&arguments, text.as_bytes()).ok();
        let written: Value = serde_json::from_slice(&place.file("models/plan.json")).unwrap();
        let file = written["objects"][0]["file"].as_str().unwrap();
        let mut found: Vec<_> =
            std::fs::read_dir(place.path().join("models")).unwrap().map(|f| f.unwrap().file_name()).collect();
        found.sort();
        let mut expected = vec![std::ffi::OsString::from("plan.json"), file.into()];
        expected.sort();
        assert_eq!(found, expected);
    }
}

#[test]
fn what_cannot_be_planned_exits_with_3_and_says_why() {
    let place = Place::new();
    let of = |objects: &str| format!("{HEAD}{LAMPS}{objects}");
    let cases = [
        (
            "unknown.toml",
            of(&ball("a", "chrom", 0.0)),
            "object 'a': no material `chrom` in the library of 134: did you mean `chrome`?",
        ),
        ("outside.toml", of(&(ball("a", "chrome", 0.0) + &ball("b", "brass", 90.0))), "found 'b' outside or hidden"),
        ("empty.toml", of(""), "[[object]]: expected 1 to 1000 of them, found 0"),
        (
            "zero.toml",
            of(&ball("a", "chrome", 0.0)).replace("width = 64", "width = 0"),
            "image.width: expected 1 to 4096",
        ),
        (
            "circle.toml",
            format!("include = [\"circle.toml\"]\n{}", of(&ball("a", "chrome", 0.0))),
            "lead around in a circle",
        ),
        ("words.toml", "no scene".to_owned(), "expected a scene in TOML"),
    ];
    for (name, text, expected) in &cases {
        place.write(name, text.as_bytes());
        let said = place.run(&["plan", name]).fails(3);
        assert!(said.contains(expected) && said.contains(name), "{expected}: {said}");
    }
    let said = place.run(&["plan", "none.toml"]).fails(3);
    assert!(said.contains("none.toml: expected a scene (.toml), found no such file"), "{said}");
    place.write("scene.toml", of(&ball("a", "chrome", 0.0)).as_bytes());
    let said = place.run(&["plan", "scene.toml", "--tolerance", "1e-9"]).fails(3);
    assert!(said.contains("which only the materials themselves meet (the closest is"), "{said}");
    place.run(&["plan", "scene.toml", "--tolerance", "0"]).fails(2);
    place.run(&["plan", "scene.toml", "--sweep", "tolerance", "--tolerance", "0.1"]).fails(2);
    let said = place.run(&["plan", "scene.toml", "--sweep", "distance", "--object", "z"]).fails(2);
    assert!(said.contains("expected one of 'a', found 'z'"), "{said}");
    assert!(!place.names().iter().any(|name| name.ends_with(".png") || name.ends_with(".svg")), "nothing is half done");
}
