//! The factored microfacet model against the published SGD fits, over all MERL materials.

use nbrdf_core::brdf::sgd::Sgd;
use nbrdf_core::metric::{LogError, Metric, image_errors};
use nbrdf_core::render::Sphere;
use nbrdf_core::representation::factored_microfacet::FactoredMicrofacet;
use nbrdf_core::{Library, Representation, Split, data, published_fits};
use rayon::prelude::*;

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
    let (networks, fits) = (Library::load(&networks).unwrap(), published_fits::sgd(&fits).unwrap());
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
