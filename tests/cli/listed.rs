//! What is known: lists of materials, and what is told of one.

use super::support::Place;
use super::two_materials;

#[test]
fn list_names_every_built_in_material_and_its_split() {
    let place = Place::new();
    let report = place.run(&["list", "--json"]).json();
    let materials = report["materials"].as_array().unwrap();
    let chrome = materials.iter().find(|material| material["name"] == "chrome").unwrap();
    assert_eq!((&chrome["database"], &chrome["held_out"]), (&"merl".into(), &true.into()));
    assert_eq!(place.run(&["list"]).text().lines().count(), materials.len());
    two_materials(&place);
    assert_eq!(place.run(&["list", "--library", "two"]).text().lines().count(), 2);
}

#[test]
fn info_tells_energy_size_and_how_well_the_model_knows_a_material() {
    let report = Place::new().run(&["info", "chrome", "--json"]).json();
    assert_eq!((&report["bytes"]["weights"], &report["bytes"]["code"]), (&2700.into(), &128.into()));
    assert!(report["live"]["multiply_adds"].as_u64().unwrap() < report["live"]["of_multiply_adds"].as_u64().unwrap());
    assert!(report["lobe"]["share"].as_f64().unwrap() > 0.5, "chrome is nearly a mirror");
    for key in ["albedo_max", "reciprocity", "negative_share"] {
        assert!(report[key].as_f64().unwrap() >= 0.0, "{key}");
    }
    assert!(report["znbrdf"]["log_error"].as_f64().unwrap() > 0.0);
    assert!(report["znbrdf"]["studio_psnr"].as_f64().unwrap() > 5.0);
    let told = |name: &str| Place::new().run(&["info", name]).text();
    assert!(told("rgl/paper_white").contains("rgl, held out"));
    assert!(told("rgl/cc_ibiza_sunset").contains("rgl, not learned from"));
    assert!(told("gold-paint").contains("merl, learned from"));
}
