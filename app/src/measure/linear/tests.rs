use nbrdf_core::library::builtin;
use nbrdf_core::metric::{albedo_max, negative_share};
use nbrdf_core::sampling::evaluate_signed;

use super::*;

#[test]
fn points_are_judged_as_the_metrics_judge_materials() {
    let places = Places::new();
    for name in ["chrome", "white-fabric", "blue-metallic-paint"] {
        let material = builtin::shared().get(name).unwrap().material();
        let brdf = material.brdf.as_ref();
        let found = places.judge(&evaluate_signed(brdf, places.at()));
        assert_eq!(found.negative_share, negative_share(brdf), "{name}");
        assert!(found.clearly_negative_share <= found.negative_share && found.lowest >= -1.0, "{name}");
        assert!((found.albedo_max - albedo_max(brdf)).abs() < 1e-4, "{name}");
    }
}

#[test]
fn drawn_codes_have_the_mean_and_the_spread_of_the_known_ones() {
    let codes = [[1.0, 5.0], [3.0, 5.0], [1.0, 9.0], [3.0, 9.0]].map(|code| code.to_vec());
    let drawn = gaussian(&codes, 4000, 7);
    for (k, (mean, variance)) in [(2.0, 1.0), (7.0, 4.0)].into_iter().enumerate() {
        let of = |f: &dyn Fn(f64) -> f64| drawn.iter().map(|p| f(f64::from(p.code[k]))).sum::<f64>() / 4000.0;
        assert!((of(&|v| v) - mean).abs() < 0.1);
        assert!((of(&|v| (v - mean).powi(2)) / variance - 1.0).abs() < 0.1);
    }
}

#[test]
fn a_training_material_is_no_way_from_itself_and_a_middle_as_far_as_its_ends() {
    let codes = [[0.0, 0.0], [2.0, 0.0], [0.0, 4.0]].map(|code| code.to_vec());
    let known = Known::new(&codes, &[1, 2]);
    assert_eq!(known.distance(1, &codes[0]), 0.0);
    assert_eq!(known.distance(1, &[1.0, 0.0]), 1.0);
    // Nearest neighbours at 2, 2 and 4; of the first numbers alone at 0, 2 and 0.
    assert_eq!(known.neighbours[0], [0.0, 1.6]);
    assert_eq!(known.neighbours[1], [2.0, 3.6]);
    assert_eq!(standard_pairs(3).count(), 3);
    assert_eq!(standard_pairs(37).count(), 0, "no pair of a material with itself");
}
