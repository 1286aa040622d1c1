use super::*;

/// Twelve points on a plane in five dimensions, shifted.
fn rows() -> Vec<Vec<f32>> {
    let point = |i: usize| {
        let (a, b) = ((i as f32).sin() * 3.0, (i as f32 * 1.7).cos());
        vec![a + 1.0, b, a - b, 0.5 * a + 2.0, -b]
    };
    (0..12).map(point).collect()
}

#[test]
fn two_components_reproduce_points_of_a_plane() {
    let pca = Pca::learn(rows(), 2).unwrap();
    for row in rows() {
        let back = pca.reconstruct(&pca.project(&row));
        assert!(row.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-4));
    }
}

#[test]
fn components_are_orthonormal() {
    let pca = Pca::learn(rows(), 2).unwrap();
    let product = |a: usize, b: usize| dot(&pca.components[a], &pca.components[b]);
    assert!((product(0, 0) - 1.0).abs() < 1e-5 && (product(1, 1) - 1.0).abs() < 1e-5);
    assert!(product(0, 1).abs() < 1e-5);
}

#[test]
fn a_component_far_smaller_than_another_is_still_one() {
    // 30 000 times smaller, along another direction.
    let row = |i: usize| {
        let (large, small) = ((i as f32).sin() * 300.0, (i as f32 * 1.7).cos() * 1e-2);
        let mut row = vec![large; 4000];
        row.extend(vec![small; 4000]);
        row
    };
    let pca = Pca::learn_about((0..12).map(row).collect(), Centre::Mean, 2).unwrap();
    assert!((dot_double(&pca.components[1], &pca.components[1]) - 1.0).abs() < 2e-2);
    for i in 0..12 {
        let back = pca.reconstruct(&pca.project(&row(i)));
        assert!((back[7999] - row(i)[7999]).abs() < 1e-3, "{} {}", back[7999], row(i)[7999]);
    }
}

#[test]
fn sums_in_the_place_of_rows_are_those_beside_them() {
    let row = |i: usize| (0..2 * PIECE + 5).map(|k| ((i * 31 + k) as f32).sin()).collect();
    let mut rows: Vec<Vec<f32>> = (0..5).map(row).collect();
    let weights: Vec<Vec<f32>> = (0..3).map(|k| (0..5).map(|i| ((k * 7 + i) as f32).cos()).collect()).collect();
    let zero = vec![0.0; rows[0].len()];
    let beside: Vec<Vec<f32>> = weights.iter().map(|weights| combine(&zero, weights, &rows)).collect();
    combine_in_place(&weights, &mut rows);
    assert_eq!(rows, beside);
}

#[test]
fn as_many_components_as_materials_are_refused() {
    assert!(matches!(Pca::learn(rows(), 12), Err(PcaError::TooFew { components: 12, found: 12 })));
}
