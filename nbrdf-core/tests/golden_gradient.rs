//! The hand-written gradient against JAX's reverse mode in float64 (`scripts/make_golden.py gradient`).

use std::path::PathBuf;

use nbrdf_core::nbrdf::gradient::Backpropagation;
use nbrdf_core::nbrdf::objective::{Objective, features, features_into, pull_back};
use nbrdf_core::nbrdf::samples::{SampleCounts, Samples};
use nbrdf_core::{Directions, Nbrdf, Rgb, Vec3};
use safetensors::SafeTensors;

fn numbers(file: &SafeTensors, name: &str) -> Vec<f32> {
    file.tensor(name).unwrap().data().as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
}

#[test]
fn loss_and_gradient_are_those_of_jax() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/gradient.safetensors");
    let bytes = std::fs::read(path).unwrap();
    let file = SafeTensors::deserialize(&bytes).unwrap();
    let vectors = |name| numbers(&file, name).as_chunks::<3>().0.iter().copied().map(Vec3::from).collect::<Vec<_>>();
    let pairs = vectors("light").into_iter().zip(vectors("view")).map(|(light, view)| Directions::new(light, view));
    let counts = SampleCounts { log: 37, relative: 50, pixels: 9, lamps: 4 };
    let samples = Samples::new(counts, pairs.collect(), numbers(&file, "factor"));
    let own = numbers(&file, "own");
    let other = Nbrdf::published(numbers(&file, "other")).unwrap();
    let wanted = features(&samples, &samples.values(&other));

    let mut pass = Backpropagation::new([21, 21]);
    let mut values = vec![Rgb::BLACK; samples.at.len()];
    pass.forward(&own, &samples.at, &mut values);
    let mut found = vec![0.0; wanted.len()];
    features_into(&samples, &values, &mut found);
    let mut by_feature = vec![0.0; wanted.len()];
    let loss = Objective::FIT.loss(&samples, &found, &wanted, &mut by_feature);
    let mut by_value = vec![Rgb::BLACK; values.len()];
    pull_back(&samples, &values, &found, &by_feature, &mut by_value);
    let mut gradient = vec![0.0; own.len()];
    pass.backward(&own, &samples.at, &by_value, &mut gradient);

    let golden = f64::from(numbers(&file, "loss")[0]);
    assert!((loss / golden - 1.0).abs() < 1e-5, "{loss} {golden}");
    let golden = numbers(&file, "gradient");
    let largest = golden.iter().fold(0.0f32, |largest, g| largest.max(g.abs()));
    for (index, (own, golden)) in gradient.iter().zip(&golden).enumerate() {
        assert!((own - golden).abs() < 1e-4 * largest, "weight {index}: {own} {golden}");
    }
}
