//! Few measurements: a report and a chart of a small library, and refusals.

use nbrdf_core::library::builtin;
use nbrdf_core::{Database, Split};
use serde_json::Value;

use super::support::Place;

/// A library of ten training and two held-out materials.
fn small_library(place: &Place) {
    let merl = || builtin::shared().iter().filter(|entry| Database::of(&entry.name) == Database::Merl);
    let training = merl().filter(|entry| Split::of(&entry.name) == Split::Train).step_by(6).take(10);
    let held_out = merl().filter(|entry| Split::of(&entry.name) == Split::HeldOut).step_by(9).take(2);
    place.library("small", training.chain(held_out).map(|entry| entry.name.as_str()));
}

#[test]
fn reconstruct_compares_few_measurements_and_draws_a_chart() {
    let place = Place::new();
    small_library(&place);
    let arguments = ["reconstruct", "--reference", "small", "--draws", "2", "-o", "chart.svg", "--json"];
    let report = place.run(&arguments).json();
    assert_eq!((&report["learned_from"], &report["draws"]), (&10.into(), &2.into()));
    assert_eq!(report["materials"].as_array().unwrap().len(), 2);
    let rows = |key: &str| report[key].as_array().unwrap().clone();
    let error = |row: &Value| row["log_error"]["mean"].as_f64().unwrap();
    let mut seen = 0;
    for row in rows("linear_combination") {
        assert!(error(&row) > 0.0 && row["condition"]["mean"].as_f64().unwrap() > 1.0, "{row}");
        let exact = row["whole_table"] == true;
        assert_eq!(exact, row["log_error_ratio"] == 1.0 && row["samples"].as_u64().unwrap() > 100_000, "{row}");
        seen += usize::from(exact);
    }
    assert_eq!(seen, 4, "plain and ridge in two domains");
    let directions = rows("directions");
    let by = |count: u64, by: &str| directions.iter().rfind(|row| row["count"] == count && row["chosen_by"] == by);
    for count in [1, 2, 5, 10, 20] {
        let chosen = by(count, "expected_error").unwrap()["directions"].as_array().unwrap();
        assert_eq!(chosen.len() as u64, count);
    }
    assert!(error(by(20, "expected_error").unwrap()) < error(by(1, "expected_error").unwrap()));
    assert_eq!(rows("sphere_images").len(), 5);
    assert!(String::from_utf8(place.file("chart.svg")).unwrap().starts_with("<svg"));
    // The same again, on another number of threads.
    assert_eq!(place.run(&[&arguments[..], &["--threads", "1"]].concat()).json(), report);
}

#[test]
fn a_library_of_nothing_to_measure_exits_with_3_and_misused_switches_with_2() {
    let place = Place::new();
    place.library("one", ["chrome"]);
    let said = place.run(&["reconstruct", "--reference", "one"]).fails(3);
    assert!(said.contains("at least 2 training materials"), "{said}");
    let said = place.run(&["reconstruct", "--reference", "one", "--validate"]).fails(3);
    assert!(said.contains("validation MERL materials"), "{said}");
    place.run(&["reconstruct", "--draws", "0"]).fails(2);
    place.run(&["reconstruct", "-o", "chart.png"]).fails(2);
}
