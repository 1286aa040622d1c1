//! Linear systems against NumPy in float64 (`scripts/make_golden.py least_squares`).

use std::path::PathBuf;

use faer::Mat;
use nbrdf_core::linear_system::LinearSystem;
use serde_json::Value;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn assert_near(what: &str, own: &[f64], golden: &[f64], tolerance: f64) {
    let largest = golden.iter().fold(0.0f64, |largest, v| largest.max(v.abs()));
    assert_eq!(own.len(), golden.len(), "{what}");
    for (own, golden) in own.iter().zip(golden) {
        assert!((own - golden).abs() <= tolerance * largest, "{what}: {own}, by NumPy {golden}");
    }
}

#[test]
fn conditions_and_answers_are_those_of_numpy() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/least_squares.json");
    let golden: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let systems = golden["systems"].as_array().unwrap();
    assert_eq!(systems.len(), 3);
    for system in systems {
        let rows: Vec<Vec<f64>> = system["matrix"].as_array().unwrap().iter().map(numbers).collect();
        let right = numbers(&system["right"]);
        let matrix = Mat::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j]);
        let column = |j: usize| rows.iter().zip(&right).map(|(row, right)| row[j] * right).sum::<f64>();
        let slope: Vec<f64> = (0..rows[0].len()).map(column).collect();
        let (condition, damping) = (system["condition"].as_f64().unwrap(), system["damping"].as_f64().unwrap());

        let direct = LinearSystem::of(&matrix).unwrap();
        assert_near("condition", &[direct.condition()], &[condition], 1e-8);
        assert_near("ridge", &direct.solve(&slope, damping), &numbers(&system["ridge"]), 1e-9);
        assert_near("plain", &direct.solve(&slope, 0.0), &numbers(&system["plain"]), 1e-6);
        // The Gram matrix squares the condition, and with it the rounding; it needs no fewer rows than unknowns.
        if rows.len() >= rows[0].len() {
            let gram = LinearSystem::of_gram(&(matrix.transpose() * &matrix)).unwrap();
            assert_near("condition by Gram", &[gram.condition()], &[condition], 1e-4);
            assert_near("ridge by Gram", &gram.solve(&slope, damping), &numbers(&system["ridge"]), 1e-9);
        }
    }
}
