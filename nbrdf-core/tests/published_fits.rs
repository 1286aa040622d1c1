//! The published analytic fits of the MERL materials beside the published networks, and beside fits of our own.

use nbrdf_core::metric::log_error;
use nbrdf_core::representation::analytic::{Analytic, SgdLobes};
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Brdf, Directions, Library, Representation, data, published_fits};

/// Of all values at these pairs, fit over network.
fn median_ratio(at: &[Directions], network: &dyn Brdf, fit: &dyn Brdf) -> f32 {
    let pairs = evaluate(network, at).into_iter().zip(evaluate(fit, at));
    let ratios = pairs.flat_map(|(f, g)| [0, 1, 2].map(|channel| (f[channel], g[channel])));
    median(ratios.filter(|(f, _)| *f > 1e-4).map(|(f, g)| g / f).collect())
}

fn median(mut values: Vec<f32>) -> f32 {
    values.sort_by(f32::total_cmp);
    values[values.len() / 2]
}

/// Both directions within 60° of the normal: beyond, measurements, networks and fits each end differently.
fn not_grazing() -> Vec<Directions> {
    let limit = 60.0_f32.to_radians().cos();
    rus32k().iter().step_by(4).filter(|at| at.light.z > limit && at.view.z > limit).copied().collect()
}

#[test]
fn published_fits_are_as_bright_as_the_published_networks() {
    let files = ["merl_nbrdf.zip", "published_fits/sgd_merl.csv", "published_fits/abc_merl.csv"];
    let [Some(networks), Some(sgd), Some(abc)] = files.map(data::published_or_skip) else { return };
    let library = Library::load(&networks).unwrap();
    let boxed = |brdf: Box<dyn Brdf>| brdf;
    let sgd = published_fits::sgd(&sgd).unwrap().into_iter().map(|(name, fit)| (name, boxed(Box::new(fit))));
    let abc = published_fits::abc(&abc).unwrap().into_iter().map(|(name, fit)| (name, boxed(Box::new(fit))));
    let at = not_grazing();
    for (model, fits) in [("sgd", sgd.collect::<Vec<_>>()), ("abc", abc.collect())] {
        assert_eq!(fits.len(), 100);
        let ratio = |(name, fit): &(String, Box<dyn Brdf>)| {
            median_ratio(&at, &library.get(name).unwrap().network, fit.as_ref())
        };
        let ratio = median(fits.iter().map(ratio).collect());
        println!("{model}: median ratio to the networks {ratio:.4}");
        assert!((0.97..1.02).contains(&ratio), "{model}: {ratio}");
    }
}

#[test]
fn our_sgd_fits_are_not_worse_than_the_published_ones() {
    let files = ["merl_nbrdf.zip", "published_fits/sgd_merl.csv"];
    let [Some(networks), Some(sgd)] = files.map(data::published_or_skip) else { return };
    let library = Library::load(&networks).unwrap();
    let published = published_fits::sgd(&sgd).unwrap();
    let ours = Analytic::<SgdLobes>::new();
    for name in ["alum-bronze", "blue-rubber", "yellow-plastic"] {
        let material = library.get(name).unwrap().material();
        let fit = published.iter().find(|(known, _)| known == name).map(|(_, fit)| fit).unwrap();
        let reference = evaluate(material.brdf.as_ref(), rus32k());
        let error = |brdf: &dyn Brdf| log_error(rus32k(), &reference, &evaluate(brdf, rus32k()));
        let decoded = ours.decode(&ours.encode(&material).unwrap()).unwrap();
        let [theirs, own] = [error(fit), error(decoded.as_ref())];
        println!("{name}: published {theirs:.4}, ours {own:.4}");
        assert!(own <= theirs, "{name}: {own} {theirs}");
    }
}
