//! Known manifolds are charted, farther apart than principal components can.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

use super::distortion::{Distortion, geodesics};
use super::known::{Known, sphere_patch, swiss_roll};
use super::vector::{mean, squared_distance};
use super::*;

fn atlas(points: &[Vec<f64>]) -> Atlas {
    Atlas::learn(points, Options::new(2)).unwrap()
}

fn forward(atlas: &Atlas, points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    points.iter().map(|point| atlas.forward(point)).collect()
}

/// Root mean square of what no affine map of `found` explains of `wanted`, relative to its spread.
fn affine_residual(found: &[Vec<f64>], wanted: &[Vec<f64>]) -> f64 {
    let lifted = Mat::from_fn(found.len(), 3, |i, a| if a < 2 { found[i][a] } else { 1.0 });
    let wanted_rows = Mat::from_fn(wanted.len(), 2, |i, a| wanted[i][a]);
    let map = lifted.qr().solve_lstsq(&wanted_rows);
    let missing = &lifted * map - &wanted_rows;
    let middle = mean(wanted);
    missing.norm_l2() / wanted.iter().map(|point| squared_distance(point, &middle)).sum::<f64>().sqrt()
}

fn distortion(found: &[Vec<f64>], along: &[Vec<f64>]) -> Distortion {
    let n = found.len();
    let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
    Distortion::of(
        &pairs.map(|(i, j)| (squared_distance(&found[i], &found[j]).sqrt(), along[i][j])).collect::<Vec<_>>(),
    )
}

/// Two principal components.
fn principal(points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let rows: Vec<Vec<f32>> = points.iter().map(|p| p.iter().map(|&v| v as f32).collect()).collect();
    let pca = crate::representation::pca::Pca::learn(rows.clone(), 2).unwrap();
    rows.iter().map(|row| pca.project(row).into_iter().map(f64::from).collect()).collect()
}

#[test]
fn a_swiss_roll_is_unrolled_and_keeps_its_lengths() {
    let Known { points, coordinates } = swiss_roll(500, 0.0, 1);
    let atlas = atlas(&points);
    let found = forward(&atlas, &points);
    let residual = affine_residual(&found, &coordinates);
    let true_distances: Vec<Vec<f64>> =
        coordinates.iter().map(|a| coordinates.iter().map(|b| squared_distance(a, b).sqrt()).collect()).collect();
    let (own, linear) = (distortion(&found, &true_distances), distortion(&principal(&points), &true_distances));
    println!("residual {residual:.4}, {own:?}, PCA {linear:?}, agreement {:?}", atlas.agreement());
    assert!(residual < 0.05, "{residual}");
    assert!(own.stress < 0.05 && linear.stress > 5.0 * own.stress, "{own:?} {linear:?}");
}

#[test]
fn noise_off_the_roll_does_not_fold_the_chart() {
    let Known { points, coordinates } = swiss_roll(500, 0.4, 2);
    let found = forward(&atlas(&points), &points);
    let residual = affine_residual(&found, &coordinates);
    assert!(residual < 0.1, "{residual}");
}

#[test]
fn a_patch_of_a_sphere_is_flattened_with_less_distortion_than_by_principal_components() {
    let Known { points, .. } = sphere_patch(300, 3);
    let great_circle = |a: &[f64], b: &[f64]| vector::dot(a, b).clamp(-1.0, 1.0).acos();
    let along: Vec<Vec<f64>> = points.iter().map(|a| points.iter().map(|b| great_circle(a, b)).collect()).collect();
    let found = forward(&atlas(&points), &points);
    let (own, linear) = (distortion(&found, &along), distortion(&principal(&points), &along));
    println!("{own:?}, PCA {linear:?}");
    assert!(own.stress < 0.8 * linear.stress && own.correlation > linear.correlation, "{own:?} {linear:?}");
    let graph = distortion(&found, &geodesics(&points, 8));
    assert!((graph.stress - own.stress).abs() < 0.03, "ways over the graph are great circles: {graph:?}");
}

#[test]
fn there_and_back_is_the_same_place() {
    for (points, within) in [(swiss_roll(500, 0.0, 4).points, 0.2), (sphere_patch(300, 5).points, 0.02)] {
        let atlas = atlas(&points);
        let error = |point: &Vec<f64>| squared_distance(&atlas.backward(&atlas.forward(point)), point).sqrt();
        let mean = points.iter().map(error).sum::<f64>() / points.len() as f64;
        println!("there and back: {mean}");
        assert!(mean < within, "{mean}");
    }
}

#[test]
fn coordinates_of_points_between_are_between() {
    let Known { points, .. } = sphere_patch(300, 6);
    let atlas = atlas(&points);
    let middle: Vec<f64> = points[0].iter().zip(&points[1]).map(|(a, b)| 0.5 * (a + b)).collect();
    let length = squared_distance(&middle, &[0.0; 3]).sqrt();
    let on_sphere: Vec<f64> = middle.iter().map(|v| v / length).collect();
    let [a, b, between] = [&points[0], &points[1], &on_sphere].map(|point| atlas.forward(point));
    let halfway: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 0.5 * (a + b)).collect();
    let off = squared_distance(&between, &halfway).sqrt() / squared_distance(&a, &b).sqrt();
    assert!(off < 0.1, "{off}");
}

#[test]
fn far_from_all_charts_is_still_near_the_data() {
    let Known { points, .. } = sphere_patch(200, 7);
    let atlas = atlas(&points);
    for far in [[1e3, 0.0], [-1e9, 1e9], [3e38, -3e38], [f64::from(f32::MAX), 1.0]] {
        let point = atlas.backward(&far);
        assert!(point.iter().all(|v| v.is_finite() && v.abs() < 20.0), "{far:?}: {point:?}");
    }
}

#[test]
fn the_same_points_give_the_same_bits_and_impossible_ones_are_refused() {
    let Known { points, .. } = sphere_patch(200, 8);
    let [once, again] = [atlas(&points), atlas(&points)].map(|atlas| forward(&atlas, &points));
    assert_eq!(once, again);
    let refused = |points: &[Vec<f64>], dim| Atlas::learn(points, Options::new(dim)).err();
    assert!(matches!(refused(&points, 4), Some(ChartingError::TooFew { dim: 4, points: 200, length: 3 })));
    assert!(matches!(refused(&points[..3], 2), Some(ChartingError::TooFew { points: 3, .. })));
    assert!(matches!(refused(&[], 2), Some(ChartingError::TooFew { .. })));
    assert!(matches!(refused(&vec![vec![f64::NAN; 3]; 9], 2), Some(ChartingError::NotFinite)));
    assert!(matches!(refused(&vec![vec![1.0; 3]; 9], 2), Some(ChartingError::NoSpread)));
}

#[test]
fn the_connection_is_that_of_numpy() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/charting.json");
    let golden: serde_json::Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let read = |name: &str| golden[name].clone();
    let local: Vec<Vec<Vec<f64>>> = serde_json::from_value(read("local")).unwrap();
    let [weights, wanted]: [Vec<Vec<f64>>; 2] =
        ["weights", "coordinates"].map(|name| serde_json::from_value(read(name)).unwrap());
    let agreement: Vec<f64> = serde_json::from_value(read("agreement")).unwrap();
    let found = connection::connect(&local, &weights, &[0.0; 8]).unwrap();
    for (own, wanted) in found.agreement.iter().zip(agreement) {
        assert!((own - wanted).abs() < 1e-6, "{own} {wanted}");
    }
    let coordinate = |i: usize, c: usize| -> f64 {
        let of = |(k, map): (usize, &connection::Affine)| {
            let linear: f64 = (0..2).map(|a| map.linear[(c, a)] * local[k][i][a]).sum();
            weights[i][k] * (linear + map.offset[c])
        };
        found.maps.iter().enumerate().map(of).sum()
    };
    for c in 0..2 {
        let own: Vec<f64> = (0..weights.len()).map(|i| coordinate(i, c)).collect();
        let largest = own.iter().fold(0.0f64, |l, v| if v.abs() > l.abs() { *v } else { l });
        for (own, wanted) in own.iter().zip(&wanted) {
            assert!((own * largest.signum() - wanted[c]).abs() < 1e-5, "coordinate {c}: {own} {}", wanted[c]);
        }
    }
}
