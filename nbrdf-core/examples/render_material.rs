//! A built-in material on a sphere, under lamps and among soft boxes, and what it is like in figures:
//! `cargo run --release -p nbrdf-core --example render_material -- FOLDER [MATERIAL]`.

use std::path::Path;

use nbrdf_core::library::builtin;
use nbrdf_core::metric::{albedo_max, directional_albedo};
use nbrdf_core::quality::Qualities;
use nbrdf_core::render::{Environment, Light, Progressive, Sphere};
use nbrdf_core::sampler::lobe::Lobe;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn main() -> Outcome {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("expected the folder to write to")?;
    show(folder.as_ref(), &arguments.next().unwrap_or_else(|| "gold-paint".to_owned()))
}

fn show(folder: &Path, name: &str) -> Outcome {
    // A material is a name, a reflectance, and here a network of 675 weights.
    let material = builtin::shared().get(name)?.material();
    let brdf = material.brdf.as_ref();

    // What it is like, and whether it could exist.
    let Qualities { lightness, gloss, roughness, .. } = Qualities::of(brdf);
    println!("{name}: lightness {lightness:.2}, gloss {gloss:.2}, roughness {roughness:.2}");
    for degrees in [0_u8, 45, 75] {
        let [red, green, blue] = directional_albedo(brdf, f32::from(degrees).to_radians()).0;
        println!("albedo at {degrees}°: {red:.3} {green:.3} {blue:.3}");
    }
    println!("at most {:.3} of the light comes back", albedo_max(brdf));

    // Under lamps a picture has no noise.
    Sphere::new(256, &Light::studio()).render(brdf).write_png(&folder.join("lamps.png"))?;

    // In light from all around it is sampled; a lobe fitted to the material draws where it reflects.
    let softboxes = Environment::by_name("softboxes").ok_or("expected the built-in environment")?;
    let mut picture = Progressive::new(256, softboxes, 0);
    let lobe = Lobe::fit(brdf);
    for _ in 0..16 {
        picture.pass(brdf, &lobe);
    }
    picture.image().write_png(&folder.join("softboxes.png"))?;
    Ok(())
}

#[test]
fn two_pictures_are_written() {
    let folder = tempfile::tempdir().unwrap();
    show(folder.path(), "chrome").unwrap();
    assert!(["lamps.png", "softboxes.png"].iter().all(|name| folder.path().join(name).exists()));
    assert!(show(folder.path(), "chrme").unwrap_err().to_string().contains("chrome"));
}
