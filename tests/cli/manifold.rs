//! The manifold of materials: figures and a map.

use serde_json::Value;

use super::{support::Place, two_materials};

#[test]
fn manifold_measures_charts_beside_principal_components_and_draws_a_map() {
    let place = Place::new();
    let report = place.run(&["manifold", "--pairs", "2", "-o", "map.svg", "--json"]).json();
    let row = |name: &str| -> &Value {
        let rows = report["rows"].as_array().unwrap();
        rows.iter().find(|row| row["name"] == name).unwrap_or_else(|| panic!("{name}: {report}"))
    };
    let figure = |name: &str, path: &str| row(name).pointer(path).and_then(Value::as_f64).unwrap();
    for kind in ["pca", "charting"] {
        let [few, many] = [2, 15].map(|dim| figure(&format!("{kind}_{dim}"), "/table_error/mean"));
        assert!(many < 0.5 * few, "{kind}: {many} with 15 numbers, {few} with 2");
    }
    assert!(figure("charting_2", "/table_error/mean") < figure("pca_2", "/table_error/mean"));
    assert_eq!(row("charting_15")["middles"]["albedo_max"]["worst"].as_array().unwrap().len(), 2);
    let growth = report["growth"].as_array().unwrap();
    assert!(growth.len() > 5 && growth.iter().all(|step| step["dimension"].as_f64().unwrap() > 1.0), "{growth:?}");
    let map = String::from_utf8(place.file("map.svg")).unwrap();
    assert_eq!(
        (map.matches("<circle class=\"place\"").count(), map.matches("<rect class=\"place\"").count()),
        (80, 20)
    );
    assert!(map.matches("class=\"name\"").count() > 60, "most names have room");
}

#[test]
fn a_library_too_small_for_a_chart_and_a_map_of_another_kind_are_refused() {
    let place = Place::new();
    two_materials(&place);
    let said = place.run(&["manifold", "--reference", "two"]).fails(3);
    assert!(said.contains("training materials"), "{said}");
    place.run(&["manifold", "-o", "map.png"]).fails(2);
}
