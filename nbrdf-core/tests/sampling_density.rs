//! Whether samplers draw what their densities say: chi-square tests, and densities that integrate to 1.

#[path = "support/bins.rs"]
mod bins;

use bins::Bins;
use nbrdf_core::{
    Sampler,
    nbrdf::fit::generator,
    sampler::{blinn_phong::BlinnPhong, cosine::Cosine, lobe::Lobe, uniform::Uniform},
};
use rand::RngExt;
use statrs::distribution::{ChiSquared, ContinuousCDF};

const SAMPLES: u32 = 100_000;
/// Bins of fewer expected samples are merged.
const FEWEST: f64 = 10.0;
/// Chance that a right sampler fails any of the tests of one function.
const RISK: f64 = 0.01;

/// Polar angle and azimuth \[degrees, rad\].
const VIEWS: [(f64, f64); 6] = [(0.0, 0.0), (10.0, -2.5), (30.0, 0.0), (45.0, 1.0), (60.0, 2.1), (80.0, 0.0)];
const GRAZING: [(f64, f64); 3] = [(85.0, 0.3), (89.0, 0.0), (89.9, 0.0)];
const WIDTHS: [f32; 6] = [1e-3, 1e-2, 0.05, 0.2, 0.5, 1.0];

/// Name, width around the mirror direction, sampler.
type Named = (String, f32, Box<dyn Sampler>);

/// Chance of counts at least as far from the density as these, if the density is right.
fn p_value(bins: &Bins, sampler: &dyn Sampler, density: &dyn Sampler, seed: u64) -> f64 {
    let rng = &mut generator(seed, 0);
    let counts = bins.counts((0..SAMPLES).map(|_| sampler.sample(bins.view, [rng.random(), rng.random()]).light));
    let expected = bins.masses(density);
    let (mut statistic, mut merged, mut pending) = (0.0, 0, (0.0, 0.0));
    for (count, expected) in counts.into_iter().zip(expected) {
        pending = (pending.0 + f64::from(count), pending.1 + expected * f64::from(SAMPLES));
        if pending.1 >= FEWEST {
            statistic += (pending.0 - pending.1).powi(2) / pending.1;
            merged += 1;
            pending = (0.0, 0.0);
        }
    }
    assert!(merged > 10, "only {merged} bins");
    ChiSquared::new(f64::from(merged - 1)).expect("degrees of freedom are positive").sf(statistic)
}

fn assert_drawn_as_said(samplers: &[Named], views: &[(f64, f64)]) {
    let limit = RISK / (samplers.len() * views.len()) as f64;
    for (k, (name, width, sampler)) in samplers.iter().enumerate() {
        for &(degrees, phi) in views {
            let bins = Bins::new(degrees.to_radians(), phi, f64::from(*width));
            let p = p_value(&bins, &**sampler, &**sampler, k as u64);
            assert!(p > limit, "{name} seen from {degrees} degrees: p = {p:e}, limit {limit:e}");
        }
    }
}

fn lobes() -> Vec<Named> {
    let mut found: Vec<Named> = Vec::new();
    for width in WIDTHS {
        for share in [0.1, 0.5, 0.98] {
            let lobe = Lobe { share, width };
            found.push((format!("{lobe:?}"), width, Box::new(lobe)));
        }
    }
    found
}

fn blinn_phongs() -> Vec<Named> {
    let one = |width: f32| {
        let lobe = BlinnPhong { share: 0.7, exponent: 2.0 / (width * width) - 2.0 };
        (format!("{lobe:?}"), width, Box::new(lobe) as Box<dyn Sampler>)
    };
    WIDTHS.map(one).into()
}

fn whole() -> Vec<Named> {
    vec![("uniform".to_owned(), 1.0, Box::new(Uniform)), ("cosine".to_owned(), 1.0, Box::new(Cosine))]
}

fn all_views() -> Vec<(f64, f64)> {
    [&VIEWS[..], &GRAZING].concat()
}

#[test]
fn lobes_draw_what_their_density_says() {
    assert_drawn_as_said(&lobes(), &all_views());
}

#[test]
fn uniform_and_cosine_draw_what_their_density_says() {
    assert_drawn_as_said(&whole(), &all_views());
}

/// Not at grazing views, where the pole of its density is too sharp for these bins.
#[test]
fn blinn_phong_lobes_draw_what_their_density_says() {
    assert_drawn_as_said(&blinn_phongs(), &VIEWS);
}

#[test]
fn a_density_five_percent_too_wide_is_noticed() {
    let (lobe, wider) = (Lobe { share: 0.9, width: 0.05 }, Lobe { share: 0.9, width: 0.0525 });
    for (degrees, phi) in all_views() {
        let p = p_value(&Bins::new(degrees.to_radians(), phi, 0.05), &lobe, &wider, 1);
        assert!(p < 1e-6, "{degrees} degrees: p = {p:e}");
    }
}

#[test]
fn densities_integrate_to_one() {
    let integrates = |samplers: Vec<Named>, views: &[(f64, f64)], tolerance: f64| {
        for (name, width, sampler) in samplers {
            for &(degrees, phi) in views {
                let bins = Bins::new(degrees.to_radians(), phi, f64::from(width));
                let mass: f64 = bins.masses(&*sampler).iter().sum();
                assert!((mass - 1.0).abs() < tolerance, "{name} seen from {degrees} degrees: {mass}");
            }
        }
    };
    integrates(lobes(), &all_views(), 1e-3);
    integrates(whole(), &all_views(), 1e-3);
    integrates(blinn_phongs(), &VIEWS, 1e-2);
}
