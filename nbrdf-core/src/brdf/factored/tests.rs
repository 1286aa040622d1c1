use std::f64::consts::FRAC_PI_2 as QUARTER;

use proptest::prelude::*;

use super::*;
use crate::Vec3;
use crate::sampling::rus32k;

/// Factors without symmetry between entries, factors or channels.
fn uneven() -> [Factors; 3] {
    [0.3, 0.5, 0.9].map(|scale: f32| Factors {
        diffuse: 0.1 * scale,
        specular: 1.0 + scale,
        distribution: std::array::from_fn(|k| 30.0 * scale * (-(k as f32) / 20.0).exp()),
        fresnel: std::array::from_fn(|k| 0.2 + scale * (k as f32 / 90.0).powi(3)),
        shadowing: std::array::from_fn(|k| 1.0 - scale * (k as f32 / 90.0).powi(2)),
    })
}

/// The formula in f64, with trigonometry, straight from the documentation of the tables.
fn formula(factors: &Factors, at: Directions) -> f64 {
    let [light, view] = [at.light, at.view].map(|v| v.as_dvec3().normalize());
    let half = (light + view).normalize();
    let read = |table: &[f32], place: f64| {
        let place = place.clamp(0.0, (table.len() - 1) as f64);
        let low = (place as usize).min(table.len() - 2);
        f64::from(table[low]) + (place - low as f64) * (f64::from(table[low + 1]) - f64::from(table[low]))
    };
    let mut shadowing = factors.shadowing.to_vec();
    shadowing.push(0.0);
    let theta_half = half.x.hypot(half.y).atan2(half.z);
    let theta_diff = light.cross(half).length().atan2(light.dot(half));
    let side = |v: glam::DVec3| read(&shadowing, 90.0 * v.x.hypot(v.y).atan2(v.z) / QUARTER) / v.z;
    let distribution = read(&factors.distribution, 90.0 * (theta_half / QUARTER).sqrt() - 0.5);
    let fresnel = read(&factors.fresnel, 90.0 * theta_diff / QUARTER - 0.5);
    let lobe = f64::from(factors.specular) * distribution * fresnel * side(light) * side(view);
    f64::from(factors.diffuse) + lobe
}

#[test]
fn values_are_those_of_the_formula_in_f64() {
    let factors = uneven();
    let factored = Factored::new(&factors);
    let mut found = vec![Rgb::BLACK; rus32k().len()];
    factored.eval_into(rus32k(), &mut found);
    for (&at, found) in rus32k().iter().zip(found) {
        for (channel, factors) in factors.iter().enumerate() {
            let exact = formula(factors, at);
            let relative = (f64::from(found[channel]) - exact).abs() / exact;
            assert!(relative < 1e-4, "{at:?}: {} {exact}", found[channel]);
        }
    }
}

#[test]
fn towards_the_horizon_values_settle() {
    let factored = Factored::new(&uneven());
    let view = Vec3::new(-0.6, 0.0, 0.8);
    let at = |z: f32| factored.eval(Directions::new(Vec3::new((1.0 - z * z).sqrt(), 0.0, z), view));
    let near = at(1e-4);
    for z in [1e-5, 1e-7, 1e-12, 1e-25, 1e-37] {
        assert!(near.zip(at(z), |a, b| (a - b).abs() / a).max() < 0.02, "{z}: {near:?} {:?}", at(z));
    }
    assert_eq!(at(0.0), Rgb::BLACK);
}

#[test]
fn what_is_below_zero_counts_as_zero() {
    let mut factors = uneven();
    factors[1].diffuse = -1.0;
    factors[1].fresnel = [-0.5; ENTRIES];
    let factored = Factored::new(&factors);
    for at in rus32k().iter().step_by(101) {
        let value = factored.eval(*at);
        assert!(value[1] == 0.0 && value[0] > 0.0, "{value:?}");
    }
}

proptest! {
    #[test]
    fn any_numbers_are_a_reflectance(
        numbers in prop::collection::vec(prop::num::f32::ANY, 8),
        theta_i in 0.0..1.57_f32, theta_o in 0.0..3.2_f32, phi in -3.2..3.2_f32,
    ) {
        let factors = Factors {
            diffuse: numbers[0],
            specular: numbers[1],
            distribution: std::array::from_fn(|k| numbers[2 + k % 2]),
            fresnel: std::array::from_fn(|k| numbers[4 + k % 2]),
            shadowing: std::array::from_fn(|k| numbers[6 + k % 2]),
        };
        let factored = Factored::new(&[factors.clone(), factors.clone(), factors]);
        let at = Directions::from_angles(theta_i, 0.0, theta_o, phi);
        let value = factored.eval(at);
        prop_assert!(value.is_finite() && value.min() >= 0.0, "{value:?}");
        prop_assert!(at.is_above() || value == Rgb::BLACK);
    }
}
