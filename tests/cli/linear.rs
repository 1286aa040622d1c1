//! Linear models and tables: measured, drawn, and kept out of files too small for them.

use serde_json::Value;

use super::support::Place;

/// Five training materials, and two held-out ones.
pub const FEW: [&str; 7] =
    ["chrome", "gold-paint", "blue-rubber", "white-fabric", "alum-bronze", "green-plastic", "chrome-steel"];

#[test]
fn linear_tells_rank_and_physics_of_what_is_spanned_and_draws_both() {
    let place = Place::new();
    place.library("few", FEW);
    let arguments = ["linear", "--reference", "few", "--draws", "6", "-o", "a.svg", "--ranks", "b.svg", "--json"];
    let report = place.run(&arguments).json();
    assert_eq!((&report["draws"], &report["held_out"]), (&6.into(), &2.into()));
    let frames = report["singular_values"].as_array().unwrap();
    let rank = |frame: &str| {
        let row = frames.iter().find(|row| row["frame"] == frame && row["values"] == "plain").unwrap();
        assert_eq!((row["singular_values"].as_array().unwrap().len(), &row["singular_values"][0]), (90, &1.0.into()));
        row["effective_rank"]["mean"].as_f64().unwrap()
    };
    assert!(rank("half_difference") < rank("standard"));
    let kinds = report["kinds"].as_array().unwrap();
    assert_eq!(
        kinds.iter().map(|kind| kind["values"].as_str().unwrap()).collect::<Vec<_>>(),
        ["plain", "log", "log_relative"]
    );
    let last = |kind: &Value| kind["rows"].as_array().unwrap().last().unwrap().clone();
    assert!(last(&kinds[0])["drawn"]["negative_share"].as_f64().unwrap() > 0.0, "{}", kinds[0]);
    let lowest = |kind: &Value| last(kind)["drawn"]["lowest"].as_f64().unwrap();
    // Of logarithms a thousandth over the cosine, of relative ones over both cosines, floored at a thousandth.
    assert!(lowest(&kinds[1]) > -1.1e-3 && lowest(&kinds[2]) > -1.0, "{kinds:?}");
    assert!(kinds.iter().all(|kind| last(kind)["held_out"]["log_error"]["mean"].as_f64().unwrap() > 0.0));
    for chart in ["a.svg", "b.svg"] {
        assert!(String::from_utf8(place.file(chart)).unwrap().contains("<polyline"), "{chart}");
    }
    assert_eq!(place.run(&arguments).json(), report, "the same seed draws the same points");
}

#[test]
fn linear_refuses_charts_of_other_kinds_and_libraries_without_enough_to_learn_from() {
    let place = Place::new();
    place.run(&["linear", "-o", "chart.png"]).fails(2);
    place.run(&["linear", "--draws", "0"]).fails(2);
    place.library("one", ["chrome"]);
    let said = place.run(&["linear", "--reference", "one"]).fails(3);
    assert!(said.contains("3 or more"), "{said}");
}

#[test]
fn tables_are_measured_with_the_bytes_they_take_and_without_their_numbers() {
    let place = Place::new();
    place.library("few", FEW);
    let arguments =
        ["evaluate", "--reference", "few", "--with", "table", "--with", "table_half", "--per-material", "--json"];
    let report = place.run(&arguments).json();
    let rows = report["rows"].as_array().unwrap();
    let bytes: Vec<u64> = rows.iter().map(|row| row["bytes"].as_u64().unwrap()).collect();
    assert_eq!(bytes, [4 * 4_374_000, 2 * 4_374_000]);
    assert!(rows[0]["materials"][0].get("code").is_none() && rows[0]["materials"][0]["log_error"].is_number());
    assert!(place.run(&["encode", "chrome", "--with", "table"]).fails(2).contains("4374000"));
}
