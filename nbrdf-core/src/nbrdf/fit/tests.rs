use super::*;
use crate::library::builtin;
use crate::metric::{ImageMetric, Metric, Rendered};

#[test]
fn adaptive_angular_sampling_finds_highlights_that_even_sampling_misses() {
    let chrome = &builtin::shared().get("chrome").unwrap().network;
    let error = |angular| {
        let options = FitOptions { steps: 1500, angular, ..FitOptions::default() };
        let fitted = fit(&random_network(0, 0), chrome, options, &|| false).unwrap();
        Rendered::point(ImageMetric::Psnr).distance(chrome, &fitted)
    };
    let (adaptive, even) = (error(Angular::HalfDifference), error(Angular::SolidAngle));
    println!("chrome under one lamp: {adaptive:.1} dB adaptive, {even:.1} dB even");
    assert!(adaptive > even + 1.0, "{adaptive} dB, {even} dB");
}

#[test]
fn a_fit_without_steps_is_its_start_and_a_cancelled_one_is_none() {
    let (start, target) = (random_network(1, 0), random_network(2, 0));
    let none = FitOptions { steps: 0, ..FitOptions::default() };
    assert_eq!(fit(&start, &target, none, &|| false).unwrap(), start);
    assert!(fit(&start, &target, FitOptions::default(), &|| true).is_none());
}
