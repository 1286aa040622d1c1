//! Analytic lobes against NumPy's float64 (`scripts/make_golden.py lobes`).

use std::path::PathBuf;

use nbrdf_core::brdf::abc::Abc;
use nbrdf_core::brdf::free_fresnel::{Facets, FreeFresnel};
use nbrdf_core::brdf::sgd::{Sgd, Shadowing, ShiftedGamma};
use nbrdf_core::brdf::ward::Ward;
use nbrdf_core::sampling::evaluate_signed;
use nbrdf_core::{Brdf, Directions, Rgb, Vec3};
use serde_json::Value;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn rgb(value: &Value) -> [f32; 3] {
    [0, 1, 2].map(|channel| number(&value[channel]) as f32)
}

fn vectors(value: &Value) -> Vec<Vec3> {
    value.as_array().unwrap().iter().map(|v| Vec3::from(rgb(v))).collect()
}

fn lobe(name: &str, of: &Value) -> Box<dyn Brdf> {
    let [diffuse, specular, a, f0, f90] = ["diffuse", "specular", "a", "f0", "f90"].map(|key| {
        let value = &of[key];
        if value.is_array() { Rgb(rgb(value)) } else { Rgb::BLACK }
    });
    let single = |key: &str| number(&of[key]) as f32;
    if name.starts_with("ward") {
        Box::new(Ward { diffuse, specular, alpha: single("alpha") })
    } else if name.starts_with("abc") {
        Box::new(Abc { diffuse, a, b: single("b"), c: single("c"), ior: single("ior") })
    } else if name.starts_with("free_fresnel") {
        let facets = if of["facets"] == "ggx" { Facets::Ggx } else { Facets::BlinnPhong };
        Box::new(FreeFresnel { diffuse, f0, f90, alpha: single("alpha"), facets })
    } else {
        Box::new(Sgd { channels: [0, 1, 2].map(|channel| shifted_gamma(of, channel)) })
    }
}

fn shifted_gamma(of: &Value, channel: usize) -> ShiftedGamma {
    let single = |key: &str| number(&of[key][channel]) as f32;
    ShiftedGamma {
        diffuse: single("diffuse"),
        specular: single("specular") * single("kappa"),
        alpha: single("alpha"),
        p: single("p"),
        f0: single("f0"),
        f1: single("f1"),
        shadowing: Shadowing::new(single("lam"), number(&of["c"][channel]), single("k"), single("theta0")),
    }
}

#[test]
fn lobes_are_those_of_numpy() {
    let golden = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/lobes.json");
    let golden: Value = serde_json::from_slice(&std::fs::read(golden).unwrap()).unwrap();
    let pairs = vectors(&golden["light"]).into_iter().zip(vectors(&golden["view"]));
    let at: Vec<Directions> = pairs.map(|(light, view)| Directions::new(light, view)).collect();
    assert_eq!(at.len(), 100);
    let lobes = golden["lobes"].as_object().unwrap();
    assert_eq!(lobes.len(), 7);
    for (name, of) in lobes {
        let lobe = lobe(name, of);
        let wanted = of["f"].as_array().unwrap();
        let found = evaluate_signed(lobe.as_ref(), &at);
        for (index, (found, wanted)) in found.iter().zip(wanted).enumerate() {
            for channel in 0..3 {
                let (found, wanted) = (f64::from(found[channel]), number(&wanted[channel]));
                // A power of 200 turns the last digit of an angle into two.
                let apart = (found - wanted).abs() / (wanted.abs() + 1e-2);
                assert!(apart < 1e-4, "{name}, pair {index}, channel {channel}: {found} {wanted}");
            }
            let alone = lobe.eval(at[index]);
            assert_eq!(alone, found.map(|f| f.max(0.0)), "{name}: alone as among others");
        }
    }
}
