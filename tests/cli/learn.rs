//! Bases: learned, saved, and asked for codes that only they can read.

use nbrdf_core::tensor_file::{Numbers, TensorFile};

use super::linear::FEW;
use super::support::Place;

#[test]
fn a_code_travels_with_the_basis_that_made_it() {
    let place = Place::new();
    place.library("few", FEW);
    let learned =
        place.run(&["learn", "pca_tables", "--library", "few", "--numbers", "3", "-o", "b.safetensors", "--json"]);
    let learned = learned.json();
    assert_eq!((&learned["dim"], &learned["materials"]), (&3.into(), &5.into()));
    // The checkpoint says which representation is meant.
    let code = place.run(&["encode", "chrome", "--checkpoint", "b.safetensors", "-o", "c.json", "--json"]).json();
    assert_eq!((&code["model"], &code["checkpoint"]), (&"pca_tables".into(), &learned["checkpoint"]));
    assert_eq!(code["code"].as_array().unwrap().len(), 3);
    place.run(&["render", "c.json", "--checkpoint", "b.safetensors", "-o", "c.png", "--size", "32"]).ok();
    let elsewhere = place.run(&["render", "c.json", "-o", "d.png"]).fails(3);
    assert!(elsewhere.contains("use that checkpoint, or encode again"), "{elsewhere}");
    // Where nobody asks for it, it is not passed over in silence.
    for arguments in [
        &["axes"][..],
        &["edit", "chrome", "gloss+0.1"],
        &["info", "chrome"],
        &["blend", "chrome", "blue-fabric", "--method", "linear_mix", "-o", "x.png"],
        &["render", "chrome", "-o", "x.png"],
        &["evaluate", "--with", "lambert"],
        &["compare", "--method", "linear_mix", "--pairs", "1", "--no-families"],
    ] {
        let said = place.run(&[arguments, &["--checkpoint", "b.safetensors"]].concat()).fails(2);
        assert!(said.contains("which is not asked for here"), "{said}");
    }
    let seen = place.run(&["evaluate", "--validate", "--with", "pca_tables", "--checkpoint", "b.safetensors"]).fails(2);
    assert!(seen.contains("learn it with --validate"), "{seen}");
    let other = place.run(&["encode", "chrome", "--with", "pca_45", "--checkpoint", "b.safetensors"]).fails(2);
    assert!(other.contains("is of pca_tables, not of pca_45"), "{other}");
}

#[test]
fn what_is_no_basis_is_refused() {
    let place = Place::new();
    place.library("few", FEW);
    let learn = |arguments: &[&str]| {
        let all = [&["learn", "-o", "b.safetensors", "--library", "few"], arguments].concat();
        place.run(&all)
    };
    assert!(learn(&["nbrdf"]).fails(2).contains("invalid value 'nbrdf'"));
    assert!(learn(&["charting_2", "--grid", "merl"]).fails(2).contains("leave out --grid"));
    assert!(learn(&["linear_combination", "--numbers", "3"]).fails(2).contains("leave out --numbers"));
    assert!(learn(&["charting_2", "--numbers", "65"]).fails(2).contains("64 at most"));
    assert!(learn(&["pca_45", "--grid", "merl", "--numbers", "121"]).fails(2).contains("120 at most"));
    assert!(learn(&["pca_tables"]).fails(3).contains("more than 32 training materials, found 5"));
    assert!(!place.names().contains(&"b.safetensors".to_owned()));
    let header = |name: &str, schema: u32| {
        serde_json::json!({"schema": schema, "name": name, "checkpoint": "c", "details": null}).to_string()
    };
    let refusal = |header: String| {
        let file = TensorFile::new("basis", header).with("mean", &[1], Numbers::F32(vec![0.0]));
        let file = file.with("cells", &[2], Numbers::U32(vec![7, 7]));
        file.save(&place.path().join("x.safetensors")).unwrap();
        place.run(&["encode", "chrome", "--checkpoint", "x.safetensors"]).fails(3)
    };
    assert!(refusal(header("nonsense", 1)).contains("expected a basis that is known here, found 'nonsense'"));
    assert!(refusal(header("pca_45", 2)).contains("expected a basis of schema 1, found schema 2"));
    assert!(refusal("{}".to_owned()).contains("missing field"));
    assert!(refusal(header("pca_45", 1)).contains("the details of pca_45"));
    assert!(refusal(header("charting_2", 1)).contains("the details of charting_2"));
    assert!(refusal(header("pca_weights", 1)).contains("tensor 'mean' of shape [675], found shape [1]"));
    assert!(refusal(header("linear_combination", 1)).contains("one or more rising cells"));
    assert!(refusal(header("\u{1b}[31m", 1)).contains("the name and the mark of a basis"));
    let huge = TensorFile::new("basis", header("pca_weights", 1))
        .with("mean", &[675], Numbers::F32(vec![3e38; 675]))
        .with("components", &[1, 675], Numbers::F32(vec![0.0; 675]));
    huge.save(&place.path().join("x.safetensors")).unwrap();
    let said = place.run(&["encode", "chrome", "--checkpoint", "x.safetensors"]).fails(3);
    assert!(said.contains("numbers within") && said.contains("tensor 'mean'"), "{said}");
}
