//! The published analytic fits of the MERL materials, and ours of the same formulas, against the published networks:
//! `log_error`, mean over all 100 and over the 20 held-out ones.
//!
//!     cargo run --release -p nbrdf-core --example published_fits

use std::error::Error;
use std::time::Instant;

use nbrdf_core::metric::{LogError, Metric};
use nbrdf_core::representation::analytic::{
    AbcLobe, Analytic, BlinnPhongLobe, GgxLobe, LambertAlone, Parametric, SgdLobes, WardLobe,
};
use nbrdf_core::{Brdf, Library, Material, Representation, Split, data, published_fits};

fn main() -> Result<(), Box<dyn Error>> {
    let file = |name: &str| data::published(name).ok_or(format!("{name} is not in {}", data::folder().display()));
    let materials = Library::load(&file("merl_nbrdf.zip")?)?.materials();
    let sgd = published_fits::sgd(&file("published_fits/sgd_merl.csv")?)?;
    let abc = published_fits::abc(&file("published_fits/abc_merl.csv")?)?;
    report("sgd, published", &materials, |material| Ok(Box::new(of(&sgd, material)?)))?;
    report("abc, published", &materials, |material| Ok(Box::new(of(&abc, material)?)))?;
    fitted::<LambertAlone>(&materials)?;
    fitted::<BlinnPhongLobe>(&materials)?;
    fitted::<WardLobe>(&materials)?;
    fitted::<GgxLobe>(&materials)?;
    fitted::<AbcLobe>(&materials)?;
    fitted::<SgdLobes>(&materials)
}

fn of<T: Copy>(fits: &[(String, T)], material: &Material) -> Result<T, String> {
    let fit = fits.iter().find(|(name, _)| *name == material.name).map(|(_, fit)| *fit);
    fit.ok_or(format!("no published fit of {}", material.name))
}

fn fitted<P: Parametric>(materials: &[Material]) -> Result<(), Box<dyn Error>> {
    let formula = Analytic::<P>::new();
    report(&format!("{}, ours", P::NAME), materials, |material| Ok(formula.decode(&formula.encode(material)?)?))
}

fn report(
    name: &str,
    materials: &[Material],
    model: impl Fn(&Material) -> Result<Box<dyn Brdf>, Box<dyn Error>>,
) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let brdfs = materials.iter().map(model).collect::<Result<Vec<_>, _>>()?;
    let each = start.elapsed().as_secs_f64() / materials.len() as f64;
    let errors: Vec<(f64, &str)> = materials
        .iter()
        .zip(&brdfs)
        .map(|(material, brdf)| (LogError.distance(material.brdf.as_ref(), brdf.as_ref()), material.name.as_str()))
        .collect();
    let mean = |errors: &[(f64, &str)]| errors.iter().map(|(error, _)| error).sum::<f64>() / errors.len() as f64;
    let held_out: Vec<_> = errors.iter().copied().filter(|(_, name)| Split::of(name) == Split::HeldOut).collect();
    let (worst, at) = errors.iter().copied().fold((0.0, ""), |worst, one| if one.0 > worst.0 { one } else { worst });
    println!(
        "{name:28} all {:.5}  held out {:.5}  worst {worst:.4} ({at})  {each:.2} s each",
        mean(&errors),
        mean(&held_out)
    );
    Ok(())
}
