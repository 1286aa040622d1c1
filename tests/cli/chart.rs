//! Charts: measured, saved, drawn again.

use serde_json::{Value, json};

use super::support::Place;

fn point(name: &str, ns: f64, error: f64) -> Value {
    json!({
        "name": name, "variant": "fitted", "family": "network", "ns": ns, "ratio_to_reference_loop": 400.0 / ns,
        "bytes": 100, "shared_bytes": 0, "encode_s": 0.1,
        "error": {"studio_flip": {"mean": error, "p10": 0.5 * error, "p90": 2.0 * error, "max": 3.0 * error}},
    })
}

#[test]
fn a_saved_report_is_drawn_again_without_measuring() {
    let place = Place::new();
    let points = [point("cheap", 1.0, 0.1), point("beaten", 20.0, 0.05), point("close & dear", 10.0, 0.01)];
    let report = json!({"schema": 1, "reference": "published", "materials": 20, "quick": false, "points": points});
    place.write("saved.json", report.to_string().as_bytes());
    let again = place.run(&["chart", "--from", "saved.json", "-o", "a.svg", "--json"]).json();
    assert_eq!(again["front"], json!(["cheap", "close & dear"]));
    assert_eq!(again["points"], report["points"]);
    assert_eq!((&again["runs"], &again["fronts"]), (&json!(1), &json!([again["front"]])), "a report of one run");
    let svg = String::from_utf8(place.file("a.svg")).unwrap();
    assert!(svg.contains("2 of 3 models are worth their time: cheap and close &amp; dear"));
    place.run(&["chart", "--from", "saved.json", "-o", "a.png"]).ok();
    place.run(&["chart", "--from", "saved.json", "-o", "dark.png", "--dark"]).ok();
    let [light, dark] = ["a.png", "dark.png"].map(|name| place.file(name));
    assert!(light.starts_with(b"\x89PNG\r\n\x1a\n") && light != dark);
    assert_eq!(light[16..24], dark[16..24], "width and height");
    assert_eq!(light[16..20], 1840u32.to_be_bytes());
}

/// The same, with what every run took.
fn point_of_runs(name: &str, ns: &[f64], error: f64) -> Value {
    let mut sorted = ns.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut point = point(name, sorted[ns.len() / 2], error);
    let run = |&ns: &f64| json!({"ns": ns, "ratio_to_reference_loop": 400.0 / ns, "encode_s": 0.1});
    point["by_run"] = ns.iter().map(run).collect();
    point
}

#[test]
fn runs_of_a_saved_report_are_compared_and_near_ties_are_left_to_the_medians() {
    let place = Place::new();
    let of = |points: &[Value]| {
        let report = json!(
            {"schema": 1, "reference": "published", "materials": 20, "quick": false, "runs": 3, "points": points});
        place.write("saved.json", report.to_string().as_bytes());
        let text = place.run(&["chart", "--from", "saved.json", "-o", "a.svg"]).text();
        (place.run(&["chart", "--from", "saved.json", "-o", "a.svg", "--json"]).json(), text)
    };
    let steady = [
        point_of_runs("cheap", &[1.0, 2.0, 1.1], 0.1),
        point_of_runs("near", &[9.0, 9.3, 8.9], 0.05),
        point_of_runs("close", &[10.0, 9.9, 10.1], 0.01),
    ];
    let (report, text) = of(&steady);
    assert_eq!((&report["runs"], &report["stable"]), (&json!(3), &json!(true)));
    assert_eq!(report["fronts"], json!(vec![["cheap", "near", "close"]; 3]));
    assert!(text.contains("3 runs: the same front in each"), "{text}");
    assert!(String::from_utf8(place.file("a.svg")).unwrap().contains("20 held-out MERL materials, 3 runs"));
    let disturbed = point_of_runs("near", &[9.0, 15.0, 9.0], 0.05);
    let (report, text) = of(&[steady[0].clone(), disturbed, steady[2].clone()]);
    assert_eq!((&report["front"], &report["stable"]), (&json!(["cheap", "near", "close"]), &json!(false)));
    assert_eq!(report["fronts"][1], json!(["cheap", "close"]));
    assert!(text.contains("3 runs: not on the front of each: near (2 of 3)"), "{text}");
}

#[test]
fn what_is_no_report_exits_with_3_and_draws_nothing() {
    let place = Place::new();
    let one = point("one", 1.0, 0.1);
    let of = |schema: u32| json!({"schema": schema, "reference": "r", "materials": 1, "quick": true, "points": [one]});
    for (name, text) in [("a.json", "{}".to_owned()), ("b.json", "x".to_owned()), ("c.json", of(2).to_string())] {
        place.write(name, text.as_bytes());
        let said = place.run(&["chart", "--from", name, "-o", "x.svg"]).fails(3);
        assert!(said.contains(name) && said.contains("expected a report of `nbrdf chart --json`"), "{said}");
    }
    for (name, point) in [("d.json", point("minus", -1.0, 0.1)), ("e.json", point("\u{1b}[31m", 1.0, 0.1))] {
        let report = json!({"schema": 1, "reference": "r", "materials": 1, "quick": true, "points": [point]});
        place.write(name, report.to_string().as_bytes());
        assert!(place.run(&["chart", "--from", name, "-o", "x.svg"]).fails(3).contains("that nobody measures"));
    }
    for (runs, points) in [(2, json!([one])), (2, json!([point_of_runs("three", &[1.0; 3], 0.1)])), (99, json!([one]))]
    {
        let report =
            json!({"schema": 1, "reference": "r", "materials": 1, "quick": true, "runs": runs, "points": points});
        place.write("runs.json", report.to_string().as_bytes());
        place.run(&["chart", "--from", "runs.json", "-o", "x.svg"]).fails(3);
    }
    place.write("f.json", of(1).to_string().as_bytes());
    let said = place.run(&["chart", "--from", "f.json", "--metric", "point_flip", "-o", "x.svg"]).fails(3);
    assert!(said.contains("expected points with point_flip"), "{said}");
    place.run(&["chart", "--from", "missing.json", "-o", "x.svg"]).fails(3);
    place.run(&["chart", "--from", "a.json", "-o", "x.jpg"]).fails(2);
    place.run(&["chart", "--metric", "studio_psnr"]).fails(2);
    place.run(&["chart", "--runs", "0"]).fails(2);
    place.run(&["chart", "--runs", "26"]).fails(2);
    place.run(&["chart", "--from", "f.json", "--runs", "2"]).fails(2);
    assert!(!place.names().contains(&"x.svg".to_owned()));
}

#[test]
fn a_model_that_is_the_reference_itself_is_said_to_be() {
    let place = Place::new();
    let points = [point("cheap", 1.0, 0.1), point("close", 10.0, 0.01), point("nbrdf", 5.0, 0.0)];
    let report = json!({"schema": 1, "reference": "builtin", "materials": 20, "quick": false, "points": points});
    place.write("saved.json", report.to_string().as_bytes());
    let text = place.run(&["chart", "--from", "saved.json", "-o", "a.svg"]).text();
    assert!(text.contains("nbrdf is the reference itself"), "{text}");
    let svg = String::from_utf8(place.file("a.svg")).unwrap();
    assert!(svg.contains("reference: builtin; nbrdf is the reference itself"));
    assert!(svg.contains("2 of 2 models are worth their time: cheap and close"));
}

#[test]
fn a_front_too_long_for_the_title_is_named_by_its_ends() {
    let place = Place::new();
    let points: Vec<Value> = (0..6u8)
        .map(|i| point(&format!("a_model_of_a_long_name_{i}"), 2f64.powi(i.into()), 1.0 / f64::from(i + 1)))
        .collect();
    let report = json!({"schema": 1, "reference": "published", "materials": 20, "quick": false, "points": points});
    place.write("saved.json", report.to_string().as_bytes());
    place.run(&["chart", "--from", "saved.json", "-o", "a.svg"]).ok();
    let svg = String::from_utf8(place.file("a.svg")).unwrap();
    let title = "6 of 6 models are worth their time, from a_model_of_a_long_name_0 to a_model_of_a_long_name_5";
    assert!(svg.contains(title));
}

#[test]
fn points_of_two_checkpoints_are_told_apart_by_their_files() {
    let place = Place::new();
    let code = |file: Option<&str>, ns: f64, error: f64| {
        let mut point = point("znbrdf_32", ns, error);
        point["variant"] = "refined".into();
        if let Some(file) = file {
            point["file"] = file.into();
        }
        point
    };
    let points = [code(None, 10.0, 0.01), code(Some("early"), 1.0, 0.1)];
    let report = json!({"schema": 1, "reference": "published", "materials": 20, "quick": false, "points": points});
    place.write("saved.json", report.to_string().as_bytes());
    let again = place.run(&["chart", "--from", "saved.json", "-o", "a.svg", "--json"]).json();
    assert_eq!(again["front"], json!(["znbrdf_32 refined (early)", "znbrdf_32 refined"]));
    assert_eq!(again["points"], report["points"]);
}

#[test]
fn a_quick_look_measures_every_model_and_its_front_is_not_beaten() {
    let place = Place::new();
    let own = concat!(env!("CARGO_MANIFEST_DIR"), "/../autoencoder/assets/znbrdf.safetensors");
    place.write("again.safetensors", &std::fs::read(own).unwrap());
    let arguments = ["--runs", "2", "--checkpoint", "again.safetensors", "-o", "chart.svg", "--json"];
    let report = place.run(&[&["chart", "--quick"][..], &arguments].concat()).json();
    let points = report["points"].as_array().unwrap();
    let codes = points.iter().filter(|point| point["name"] == "znbrdf_32").map(|point| point.get("file"));
    assert_eq!(codes.collect::<Vec<_>>(), [[None; 3], [Some(&json!("again")); 3]].concat());
    let named = |name: &str| points.iter().find(|point| point["name"] == name).unwrap();
    for name in ["nbrdf", "znbrdf_32", "pca_45", "table", "charting_15", "linear_combination", "sgd", "lambert_ggx"] {
        assert_eq!(named(name)["by_run"].as_array().map(Vec::len), Some(2), "{name}");
        assert!(named(name)["ns"].as_f64().unwrap() > 0.0 && named(name)["bytes"].as_u64().unwrap() > 0, "{name}");
    }
    let front = report["front"].as_array().unwrap();
    assert!(front.len() >= 2 && front.iter().any(|name| name == "lambert"), "{front:?}");
    place.write("saved.json", report.to_string().as_bytes());
    place.run(&["chart", "--from", "saved.json", "-o", "again.svg"]).ok();
    assert_eq!(place.file("chart.svg"), place.file("again.svg"));
}
