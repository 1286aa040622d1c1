//! What sampling does to estimates of built-in materials: no bias, and less variance than without a lobe.

#[path = "support/bins.rs"]
mod bins;

use bins::Bins;
use nbrdf_core::{
    Brdf, Database, Sampler,
    library::builtin,
    sampler::{
        blinn_phong::BlinnPhong,
        cosine::Cosine,
        lobe::Lobe,
        uniform::Uniform,
        variance::{Variances, estimates, relative_variance, sampled_variance},
    },
    sampling::evaluate,
};
use rayon::prelude::*;

const MATERIALS: [&str; 5] = ["chrome", "gold-paint", "blue-fabric", "white-marble", "specular-blue-phenolic"];
const SAMPLES: usize = 200_000;

fn material(name: &str) -> &'static dyn Brdf {
    &builtin::shared().get(name).expect("a built-in name").network
}

fn samplers(brdf: &dyn Brdf) -> [(&'static str, Box<dyn Sampler>); 4] {
    [
        ("uniform", Box::new(Uniform)),
        ("cosine", Box::new(Cosine)),
        ("Blinn-Phong", Box::new(BlinnPhong::fit(brdf))),
        ("lobe", Box::new(Lobe::fit(brdf))),
    ]
}

#[test]
fn estimates_of_the_albedo_are_unbiased() {
    for name in MATERIALS {
        let brdf = material(name);
        let (samplers, width) = (samplers(brdf), f64::from(Lobe::fit(brdf).width));
        for degrees in [10.0, 60.0, 85.0_f64] {
            let bins = Bins::new(degrees.to_radians(), 0.5, width);
            let (at, solid_angle) = bins.points();
            let seen: Vec<f64> =
                evaluate(brdf, &at).iter().zip(&at).map(|(f, at)| f64::from(f[1] * at.light.z)).collect();
            let albedo: f64 = seen.iter().zip(&solid_angle).map(|(radiance, dw)| radiance * dw).sum();
            for (sampler_name, sampler) in &samplers {
                // The sampled standard error would be too small where samples miss the highlight.
                let terms = at.iter().zip(&seen).zip(&solid_angle);
                let squares: f64 = terms.map(|((&at, seen), dw)| seen * seen * dw / f64::from(sampler.pdf(at))).sum();
                let standard_error = ((squares - albedo * albedo) / SAMPLES as f64).sqrt();
                let drawn = estimates(brdf, &**sampler, bins.view, SAMPLES, 3);
                let mean = drawn.iter().map(|estimate| f64::from(estimate[1])).sum::<f64>() / SAMPLES as f64;
                assert!(
                    (mean - albedo).abs() < 4.0 * standard_error,
                    "{name}, {sampler_name}, {degrees} degrees: {mean} ± {standard_error}, albedo {albedo}"
                );
            }
        }
    }
}

#[test]
fn variances_by_quadrature_are_those_of_samples() {
    for name in MATERIALS {
        let brdf = material(name);
        let lobe = Lobe::fit(brdf);
        let (exact, sampled) = (relative_variance(brdf, &lobe), sampled_variance(brdf, &lobe, SAMPLES, 5));
        assert!((sampled / exact - 1.0).abs() < 0.05, "{name}: {exact} by quadrature, {sampled} by samples");
    }
}

#[test]
fn a_fitted_lobe_never_varies_more_than_the_cosine_and_mostly_far_less() {
    let merl: Vec<_> = builtin::shared().iter().filter(|entry| entry.database == Database::Merl).collect();
    let rows: Vec<_> = merl.into_par_iter().map(|entry| Variances::of(&entry.name, &entry.network)).collect();
    let improved = rows.iter().filter(|row| row.cosine > 2.0 * row.lobe).count();
    println!("{improved} of {} materials vary less than half as much as under cosine sampling", rows.len());
    assert_eq!(rows.len(), 100);
    for row in &rows {
        assert!(row.lobe <= row.cosine, "{row:?}");
        assert!(row.lobe < 1.0, "{row:?}");
    }
    assert!(improved >= 90, "{improved}");
}
