//! Measured files: looked at, fitted, refused.

use nbrdf_core::data::published_or_skip;

use super::support::Place;

#[test]
fn measured_files_are_materials_and_networks_are_fitted_to_them() {
    let place = Place::new();
    let bsdf = published_or_skip("rgl_measured/paper_white_rgb.bsdf");
    let list = published_or_skip("cornell_measured/krylon_blue.brdf");
    let (Some(bsdf), Some(list)) = (bsdf, list) else { return };
    let (bsdf, list) = (bsdf.to_str().unwrap(), list.to_str().unwrap());
    place.run(&["render", bsdf, "-o", "paper.png", "--size", "32"]).ok();
    assert_eq!(place.run(&["encode", bsdf]).json()["material"], "rgl/paper_white");
    let fitted = place.run(&["fit", bsdf, "-o", "paper.npz", "--steps", "300", "--json"]).json();
    assert!(fitted["error"]["log_error"].as_f64().unwrap() < 0.1, "{fitted}");
    let against = place.run(&["info", "paper.npz", "--against", bsdf, "--json"]).json();
    assert_eq!(against["against"]["name"], "rgl/paper_white");
    assert_eq!(against["against"]["figures"]["log_error"], fitted["error"]["log_error"]);
    assert!(place.run(&["info", "chrome", "--against", "paper.npz"]).text().contains("studio_delta_e_itp"));
    place.run(&["fit", bsdf, "-o", "no.npz", "--leave-out", "10"]).fails(2);
    let said = place.run(&["render", list, "-o", "x.png"]).fails(2);
    assert!(said.contains("nbrdf fit"), "{said}");
    let wide = ["fit", list, "-o", "blue.npz", "--steps", "300", "--hidden", "16,16", "--leave-out", "10", "--json"];
    let fitted = place.run(&wide).json();
    assert_eq!(fitted["hidden"], serde_json::json!([16, 16]));
    let said = place.run(&["fit", list, "-o", "x.safetensors", "--anisotropic"]).fails(2);
    assert!(said.contains("degrees of the half vector's azimuth"), "{said}");
    let error = |key: &str| fitted["error"][key]["median"].as_f64().unwrap();
    assert_eq!(fitted["error"]["folds"], 10);
    assert!(error("relative_error") < 1.0 && error("of_lambert_ggx") < error("of_lambert"), "{fitted}");
    assert_eq!(place.run(&["info", "blue.npz", "--json"]).json()["hidden"], serde_json::json!([16, 16]));
}

#[test]
fn a_brushed_metal_is_fitted_with_its_azimuth_rendered_and_refused_a_code() {
    let place = Place::new();
    let brushed = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/brushed.bsdf");
    place.run(&["render", brushed, "-o", "table.png", "--size", "32"]).ok();
    let said = place.run(&["encode", brushed]).fails(3);
    assert!(said.contains("brushed.bsdf") && said.contains("it has no code"), "{said}");
    place.run(&["fit", brushed, "-o", "b.npz"]).fails(2);
    let fit = |output: &str| place.run(&["fit", brushed, "-o", output, "--steps", "3000", "--json"]).json();
    let fitted = fit("b.safetensors");
    assert_eq!(fitted["anisotropic"], true);
    let error = fitted["error"]["log_error"].as_f64().unwrap();
    assert!(error < 0.06, "{error}");
    place.run(&["render", "b.safetensors", "-o", "b.png", "--size", "32"]).ok();
    for command in [&["encode", "b.safetensors"][..], &["info", "b.safetensors"], &["blend", "b.safetensors", "chrome"]]
    {
        let said = place.run(command).fails(3);
        assert!(said.contains("changes when it is turned"), "{said}");
    }
    let said = place.run(&["import", "b.safetensors", "-o", "library"]).fails(3);
    assert!(said.contains("isotropic"), "{said}");
}

#[test]
fn files_that_are_no_measurement_exit_with_3_and_write_nothing() {
    let place = Place::new();
    for (name, bytes) in [
        ("a.binary", &b"short"[..]),
        ("b.bsdf", b"tensor_file\0\x01\0\xff\xff\xff\xff"),
        ("c.brdf", b"x"),
        ("d.csv", b""),
        ("e.csv", b"light_x,light_y,light_z,view_x,view_y,view_z,r,g,b\n0,0,1,0,0,1,1e39,0,0\n"),
        ("f.brdf", b"2\n900 1000\n0.1 0 0.2 1 0.3 0.4\n"),
    ] {
        place.write(name, bytes);
        let said = place.run(&["fit", name, "-o", "out.npz"]).fails(3);
        assert!(said.contains(name) && said.contains("expected"), "{said}");
    }
    place.run(&["fit", "missing.binary", "-o", "out.npz"]).fails(3);
    place.run(&["fit", "a.binary", "-o", "out.exe"]).fails(2);
    for hidden in ["21", "0,21", "21,257", "21,21,21", "21,x"] {
        place.run(&["fit", "a.binary", "-o", "out.npz", "--hidden", hidden]).fails(2);
    }
    assert_eq!(place.names(), ["a.binary", "b.bsdf", "c.brdf", "d.csv", "e.csv", "f.brdf"]);
}
