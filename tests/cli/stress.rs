//! `nbrdf stress`: every cell a number and a verdict, failures told, reports drawn again and gone on with.

use serde_json::Value;

use crate::support::Place;

/// A quick look at few methods.
fn quick(place: &Place, more: &[&str]) -> Value {
    place.run(&[&["stress", "--quick", "--json", "--reference", "four", "-o", "s.html"], more].concat()).json()
}

/// Held-out MERL materials only, which is what decoded hazards ask for.
fn place() -> Place {
    let place = Place::new();
    place.library("four", ["aluminium", "blue-fabric", "chrome", "pink-fabric"]);
    place
}

fn cells(report: &Value) -> &Vec<Value> {
    report["cells"].as_array().unwrap()
}

#[test]
fn every_cell_has_a_value_and_the_verdict_that_its_threshold_says() {
    let place = place();
    let methods = ["--method", "lambert", "--method", "table_nearest", "--method", "reference"];
    let report = quick(&place, &[&["--hazard", "directions", "--hazard", "energy"], &methods[..]].concat());
    assert_eq!((report["schema"].as_u64(), cells(&report).len()), (Some(1), 36));
    for cell in cells(&report) {
        let [holds, fails] = ["holds", "fails"].map(|key| cell["threshold"][key].as_f64().unwrap());
        let value = cell["value"].as_f64().unwrap();
        let verdict = match value {
            _ if value <= holds => "holds",
            _ if value <= fails => "degrades",
            _ => "fails",
        };
        assert_eq!(cell["verdict"], verdict, "{cell}");
        assert!(cell["picture"].is_null() && cell["worst"].as_array().is_some_and(|worst| !worst.is_empty()));
    }
    let verdict = |hazard: &str, method: &str| {
        let is_it = |cell: &&Value| cell["hazard"] == hazard && cell["method"] == method;
        cells(&report).iter().find(is_it).unwrap()["verdict"].clone()
    };
    assert_eq!(verdict("mirror", "lambert"), "fails", "a diffuse base has no mirror direction");
    for method in ["lambert", "table_nearest", "reference"] {
        assert_eq!(verdict("horizon", method), "holds");
        assert_eq!(verdict("no_number", method), "holds");
    }
    let page = String::from_utf8(place.file("s.html")).unwrap();
    assert_eq!(page.matches("data:image/png;base64,").count(), 36);
    assert!(page.contains("<svg") && page.contains("fail: lambert"));
    let elsewhere = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!elsewhere.contains("http"), "the page fetches nothing");
    assert!(place.file("s.svg").starts_with(b"<svg"));
    assert!(!place.names().iter().any(|name| name.contains("partial")));
}

#[test]
fn znbrdf_fails_nowhere_without_a_warning() {
    let place = place();
    let kinds = ["directions", "numbers", "data", "physics"].map(|kind| ["--hazard", kind]).concat();
    let report = quick(&place, &[&kinds[..], &["--method", "znbrdf"]].concat());
    for cell in cells(&report) {
        let is_told = cell["warnings"].as_array().is_some_and(|warnings| !warnings.is_empty());
        assert!(cell["verdict"] != "fails" || is_told, "{cell}");
    }
}

#[test]
fn a_report_is_drawn_again_and_gone_on_with() {
    let place = place();
    let asked = ["--hazard", "reciprocity", "--method", "lambert"];
    let report = quick(&place, &asked);
    place.write("report.json", report.to_string().as_bytes());
    place.run(&["stress", "--from", "report.json", "-o", "again.html"]).ok();
    assert!(!String::from_utf8(place.file("again.html")).unwrap().contains("data:image"));
    // What an interrupted run leaves has the same form.
    place.write("s.partial.json", report.to_string().as_bytes());
    let resumed = quick(&place, &[&asked[..], &["--resume"]].concat());
    assert_eq!(cells(&resumed), cells(&report));
    place.write("s.partial.json", report.to_string().as_bytes());
    let other = ["stress", "--quick", "--reference", "four", "-o", "s.html", "--resume", "--hazard", "energy"];
    assert!(place.run(&other).fails(3).contains("--resume"));
}

#[test]
fn what_makes_no_sense_is_refused_and_names_are_suggested() {
    let place = place();
    let stress = |more: &[&str]| place.run(&[&["stress", "--quick", "--reference", "four"], more].concat());
    let tip = |said: String| said.lines().find(|line| line.contains("tip: ")).unwrap_or(&said).to_owned();
    assert!(tip(stress(&["--hazard", "grazing"]).fails(2)).contains("'grazing_"));
    assert!(tip(stress(&["--method", "znbrf"]).fails(2)).contains("'znbrdf'"));
    stress(&["--hazard", "seeds", "--method", "lambert"]).fails(2);
    stress(&["-o", "page.txt"]).fails(2);
    let unknown = br#"{"schema":1,"reference":"r","checkpoint":"c","extent":{"materials":1,"few":1,"ends":1,"pairs":1,"steps":1},"counted":{"materials":1,"few":1,"ends":1,"pairs":1,"steps":1},"work":"w","seed":0,"asked":[[],[]],"groups":[],"cells":[]}"#;
    for bytes in
        [&b"{}"[..], b"", b"[1,2", &unknown[..unknown.len() - 2], &unknown.map(|b| if b == b'1' { b'7' } else { b })]
    {
        place.write("bad.json", bytes);
        assert!(place.run(&["stress", "--from", "bad.json"]).fails(3).contains("bad.json"));
    }
}

#[test]
fn the_same_seed_gives_the_same_report_for_any_number_of_threads() {
    let place = place();
    let asked = ["--hazard", "noise", "--hazard", "disguised", "--method", "lambert", "--method", "znbrdf"];
    let [one, two] = ["1", "2"].map(|threads| quick(&place, &[&asked[..], &["--threads", threads]].concat()));
    assert_eq!(one, two);
}
