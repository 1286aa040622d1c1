//! The factored microfacet model against the published SGD fits, over all MERL materials.

use std::f64::consts::PI;
use std::path::Path;

use nbrdf_core::metric::{LogError, Metric, image_errors};
use nbrdf_core::render::Sphere;
use nbrdf_core::representation::factored_microfacet::FactoredMicrofacet;
use nbrdf_core::{Brdf, Directions, Library, Representation, Rgb, Split, data};
use rayon::prelude::*;

/// SGD as published (M. Bagher, C. Soler, N. Holzschuch, *Accurate fitting of measured reflectances using a Shifted Gamma
/// micro-facet distribution* (2012)), one row of `sgd_merl.csv`: the twelve parameters of every channel.
struct Sgd([[f64; 12]; 3]);

impl Brdf for Sgd {
    fn eval(&self, at: Directions) -> Rgb {
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let angles = at.rusinkiewicz();
        let (half, diff) = (f64::from(angles.theta_half), f64::from(angles.theta_diff));
        let [cos_i, cos_o] = [at.light.z, at.view.z].map(f64::from);
        let channel = |&[rho_d, rho_s, alpha, p, f0, f1, kappa, lambda, c, k, theta0, _]: &[f64; 12]| {
            let a = alpha + half.tan().powi(2) / alpha;
            let distribution = kappa * (-a).exp() / (PI * a.powf(p) * half.cos().powi(4));
            let fresnel = f0 - f1 * diff.cos() + (1.0 - diff.cos()).powi(5) * (1.0 - f0);
            let side = |cosine: f64| {
                let beyond = (cosine.acos() - theta0).max(0.0);
                (1.0 + lambda * (1.0 - (c * beyond.powf(k)).exp())).clamp(0.0, 1.0) / cosine
            };
            let f = (rho_d + rho_s * fresnel * distribution * side(cos_i) * side(cos_o)) / PI;
            if f.is_finite() { f.max(0.0) as f32 } else { 0.0 }
        };
        Rgb(self.0.each_ref().map(channel))
    }
}

fn sgd(file: &Path) -> Vec<(String, Sgd)> {
    let text = std::fs::read_to_string(file).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |i: usize| cells[i].parse::<f64>().unwrap();
        let channel = |channel: usize| std::array::from_fn(|parameter| number(3 + 3 * parameter + channel));
        (cells[0].to_owned(), Sgd([0, 1, 2].map(channel)))
    };
    text.lines().skip(1).filter(|line| !line.is_empty()).map(row).collect()
}

struct Compared {
    name: String,
    own: f64,
    sgd: f64,
    psnr: f64,
}

#[test]
fn most_materials_are_closer_than_their_published_sgd_fit() {
    let files = ["merl_nbrdf.zip", "published_fits/sgd_merl.csv"].map(data::published_or_skip);
    let [Some(networks), Some(fits)] = files else { return };
    let (networks, fits) = (Library::load(&networks).unwrap(), sgd(&fits));
    assert_eq!(fits.len(), 100);
    let sphere = Sphere::studio();
    let one = |(name, sgd): &(String, Sgd)| {
        let material = networks.get(name).unwrap().material();
        let decoded = FactoredMicrofacet.decode(&FactoredMicrofacet.encode(&material).unwrap()).unwrap();
        let reference = material.brdf.as_ref();
        let pictures = [reference, decoded.as_ref()].map(|brdf| sphere.render(brdf));
        Compared {
            name: name.clone(),
            own: LogError.distance(reference, decoded.as_ref()),
            sgd: LogError.distance(reference, sgd),
            psnr: image_errors(&pictures[0], &pictures[1], sphere.covered()).psnr,
        }
    };
    let mut compared: Vec<Compared> = fits.par_iter().map(one).collect();
    compared.sort_by(|a, b| (a.own / a.sgd).total_cmp(&(b.own / b.sgd)));
    for Compared { name, own, sgd, psnr } in &compared {
        println!("{name:28} log_error {own:.4}, SGD {sgd:.4}; studio {psnr:.1} dB");
    }
    for split in [Split::Train, Split::Validation, Split::HeldOut] {
        let chosen: Vec<&Compared> = compared.iter().filter(|one| Split::of(&one.name) == split).collect();
        let mean = |of: &dyn Fn(&Compared) -> f64| chosen.iter().map(|one| of(one)).sum::<f64>() / chosen.len() as f64;
        let worst = chosen.iter().max_by(|a, b| a.own.total_cmp(&b.own)).unwrap();
        let farthest = chosen.iter().min_by(|a, b| a.psnr.total_cmp(&b.psnr)).unwrap();
        println!(
            "{split:?}: log_error {:.4} (worst {:.4}, {}), SGD {:.4}; studio {:.1} dB (worst {:.1}, {})",
            mean(&|one| one.own),
            worst.own,
            worst.name,
            mean(&|one| one.sgd),
            mean(&|one| one.psnr),
            farthest.psnr,
            farthest.name,
        );
    }
    let closer = compared.iter().filter(|one| one.own < one.sgd).count();
    println!("closer than SGD: {closer} of {}", compared.len());
    assert!(closer >= 80, "{closer}");
}
