//! On analytic materials: what is learned, what is chosen, and what comes back.

use std::sync::OnceLock;

use super::super::log_table::{cells, measurable};
use super::super::measured_tables::tests::glossy;
use super::super::measured_tables::{MeasuredTables, random_cells};
use super::design::condition;
use super::images::SphereImages;
use super::*;
use crate::metric::{Metric, RelativeLog};
use crate::sampling::{evaluate, rus32k};

fn basis() -> Arc<LogRelative> {
    static BASIS: OnceLock<Arc<LogRelative>> = OnceLock::new();
    let learn = || Arc::new(LogRelative::learn(&MeasuredTables::of(&glossy(10)).unwrap(), 12).unwrap());
    Arc::clone(BASIS.get_or_init(learn))
}

/// Materials between those of the basis.
fn unseen() -> Vec<Material> {
    glossy(7)
}

fn error(reconstruction: &Reconstruction, material: &Material) -> f64 {
    let measured = measure(material.brdf.as_ref(), reconstruction.cells());
    RelativeLog.distance(material.brdf.as_ref(), &reconstruction.reconstruct(&measured))
}

fn mean_error(cells: Vec<usize>) -> f64 {
    let reconstruction = Reconstruction::new(basis(), cells, DAMPING);
    unseen().iter().map(|material| error(&reconstruction, material)).sum::<f64>() / unseen().len() as f64
}

#[test]
fn chosen_directions_are_distinct_above_the_horizon_and_the_same_each_time() {
    let basis = basis();
    let expected = Criterion::expected_error(&basis, DAMPING);
    for criterion in [&Criterion::ConditionNumber, &expected] {
        let chosen = choose(&basis, 5, criterion, &expected);
        assert!(chosen.len() == 5 && chosen.is_sorted_by(|a, b| a < b), "{chosen:?}");
        assert!(chosen.iter().all(|&cell| cells()[cell].is_above()));
        assert_eq!(chosen, choose(&basis, 5, criterion, &expected));
    }
}

#[test]
fn a_search_lowers_what_it_searches_for() {
    let basis = basis();
    let expected = Criterion::expected_error(&basis, DAMPING);
    let random: Vec<Vec<usize>> = (10..20).map(|seed| random_cells(5, seed)).collect();
    let best = |cost: &dyn Fn(&[usize]) -> f64| random.iter().map(|cells| cost(cells)).fold(f64::INFINITY, f64::min);
    let condition = |cells: &[usize]| condition(&basis.matrix(cells));
    let by_condition = choose(&basis, 5, &Criterion::ConditionNumber, &expected);
    assert!(condition(&by_condition) < best(&condition), "{} {}", condition(&by_condition), best(&condition));
    let cost = |cells: &[usize]| expected.cost(&basis.matrix(cells));
    let by_error = choose(&basis, 5, &expected, &expected);
    assert!(cost(&by_error) < best(&cost), "{} {}", cost(&by_error), best(&cost));
}

#[test]
fn chosen_directions_tell_more_than_random_ones() {
    let basis = basis();
    let criterion = Criterion::expected_error(&basis, DAMPING);
    for count in [5, 10] {
        let optimal = mean_error(choose(&basis, count, &criterion, &criterion));
        let random = (0..8).map(|seed| mean_error(random_cells(count, 100 + seed))).sum::<f64>() / 8.0;
        assert!(optimal < 0.9 * random, "{count} directions: {optimal} chosen, {random} at random");
    }
}

#[test]
fn more_pictures_of_a_sphere_tell_more() {
    let basis = basis();
    let images = SphereImages::new(&basis);
    let error = |lights: &[u32]| -> f64 {
        let one = |material: &Material| {
            let found = basis.table(&images.coefficients(material.brdf.as_ref(), lights).unwrap());
            RelativeLog.distance(material.brdf.as_ref(), &found)
        };
        unseen().iter().map(one).sum::<f64>() / unseen().len() as f64
    };
    let [none, one, two] = [0, 1, 2].map(|count| images.choose(count));
    assert_eq!([none.len(), one.len(), two.len()], [0, 1, 2]);
    let [without, with_one, with_two] = [error(&none), error(&one), error(&two)];
    assert!(with_one < 0.5 * without && with_two < with_one, "{without} {with_one} {with_two}");
}

#[test]
fn any_finite_code_is_a_reflectance_and_its_own_measurement_comes_back() {
    let representation = OptimalSampling::learn("optimal_sampling_5", basis(), "", 5);
    for number in [f32::MAX, -f32::MAX, 0.0] {
        let decoded = representation.decode(&representation.code(vec![number; 15])).unwrap();
        let values = evaluate(decoded.as_ref(), rus32k());
        assert!(values.iter().all(|f| f.is_finite() && f.min() >= 0.0), "{number}");
    }
    let material = unseen().swap_remove(3);
    let code = representation.encode(&material).unwrap();
    let decoded = representation.decode(&code).unwrap();
    let again = representation.encode(&Material::new("decoded", Arc::from(decoded))).unwrap();
    for (measured, again) in code.code.iter().zip(&again.code) {
        assert!((measured - again).abs() < 0.1, "{measured} {again}");
    }
}

#[test]
fn a_basis_of_every_cell_knows_the_cells_below_the_horizon_by_those_above() {
    let basis = basis();
    let below = (0..cells().len()).find(|cell| measurable().binary_search(cell).is_err()).unwrap();
    let source = super::super::log_table::sources()[below];
    assert_eq!((basis.base(below), basis.loadings(below)), (basis.base(source), basis.loadings(source)));
}
