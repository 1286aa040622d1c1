//! Singular values of tables against those of LAPACK's SVD in float64; `scripts/make_golden.py rank` says of what.

use nbrdf_core::Rgb;
use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::rank::{Frame, SingularValues};
use nbrdf_core::representation::values::Values;
use serde_json::Value;

fn golden() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/rank.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn triple(value: &Value) -> Rgb {
    Rgb(std::array::from_fn(|channel| value[channel].as_f64().unwrap() as f32))
}

#[test]
fn singular_values_of_tables_are_those_of_a_decomposition_in_double_precision() {
    let golden = golden();
    for row in golden["rows"].as_array().unwrap() {
        let material = &golden["materials"][row["material"].as_str().unwrap()];
        let alpha = material["alpha"].as_f64().unwrap() as f32;
        let ggx = Ggx { diffuse: triple(&material["diffuse"]), f0: triple(&material["f0"]), alpha };
        let frame = Frame::ALL.into_iter().find(|frame| row["frame"] == frame.name()).unwrap();
        let values = Values::ALL.into_iter().find(|values| row["values"] == values.name()).unwrap();
        let found = SingularValues::of(&ggx, frame, values).unwrap();
        for (found, expected) in found.normalised().iter().zip(row["normalised"].as_array().unwrap()) {
            let expected = expected.as_f64().unwrap();
            assert!((found - expected).abs() < 1e-5 + 1e-3 * expected, "{row}: {found}");
        }
        let expected = row["effective_rank"].as_f64().unwrap();
        assert!((found.effective_rank() / expected - 1.0).abs() < 1e-3, "{row}: {}", found.effective_rank());
    }
}
