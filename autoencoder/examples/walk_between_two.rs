//! A walk between two materials through their codes, and what it passes:
//! `cargo run --release -p autoencoder --example walk_between_two -- FOLDER [FIRST SECOND]`.

use std::path::Path;

use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::library::builtin;
use nbrdf_core::metric::albedo_max;
use nbrdf_core::path::code_path::CodeInterpolation;
use nbrdf_core::path::even::Even;
use nbrdf_core::quality::Qualities;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Image, Interpolation, Weights};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const STEPS: u8 = 7;

fn main() -> Outcome {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("expected the folder to write to")?;
    let mut name = |default: &str| arguments.next().unwrap_or_else(|| default.to_owned());
    show(folder.as_ref(), [&name("gold-paint"), &name("blue-acrylic")])
}

fn show(folder: &Path, names: [&str; 2]) -> Outcome {
    let library = builtin::shared();
    let ends = [library.get(names[0])?.material(), library.get(names[1])?.material()];

    // Codes of 32 numbers are mixed and decoded; `Even` makes equal steps of t look equally far.
    let znbrdf = Autoencoder::built_in(Architecture::Znbrdf);
    let codes = CodeInterpolation::new("latent", znbrdf.clone());
    let path = Even::new("latent_even", Box::new(codes)).between(&ends)?;

    let sphere = Sphere::studio();
    let mut spheres = Vec::new();
    for step in 0..STEPS {
        let weights = Weights::two(f32::from(step) / f32::from(STEPS - 1));
        let brdf = path.at(&weights)?;
        let distance = path.code(&weights)?.map(|code| znbrdf.distance(&code)).transpose()?.flatten();
        let Qualities { lightness, gloss, roughness, .. } = Qualities::of(brdf.as_ref());
        println!(
            "{:.2}: lightness {lightness:.2}, gloss {gloss:.2}, roughness {roughness:.2}, albedo at most {:.2}, {:.2} from known codes",
            weights.as_slice()[1],
            albedo_max(brdf.as_ref()),
            distance.unwrap_or(f64::NAN)
        );
        spheres.push(sphere.render(brdf.as_ref()));
    }

    // Side by side.
    let size = sphere.size();
    let row = |y: usize| spheres.iter().flat_map(move |picture| &picture.pixels()[y * size..][..size]);
    let pixels = (0..size).flat_map(row).copied().collect();
    Ok(Image::new(spheres.len() * size, size, pixels).write_png(&folder.join("walk.png"))?)
}

#[test]
fn a_walk_is_drawn_between_any_two_materials() {
    let folder = tempfile::tempdir().unwrap();
    show(folder.path(), ["chrome", "rgl/paper_white"]).unwrap();
    assert!(folder.path().join("walk.png").exists());
    assert!(show(folder.path(), ["chrome", "nothing"]).is_err());
}
