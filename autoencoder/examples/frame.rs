//! Frames of scrubbing on one thread: a code is decoded and its sphere rendered, so many times. What
//! `scripts/count_instructions.sh` counts.

use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::library::builtin;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Image, Representation};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let frames: usize = std::env::args().nth(1).unwrap_or_default().parse()?;
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let znbrdf = Autoencoder::built_in(Architecture::Znbrdf);
    let code = znbrdf.encode(&builtin::shared().get("gold-paint")?.material())?;
    let mut place = znbrdf.decode(&code)?;
    let sphere = Sphere::studio();
    let mut image = Image::black(sphere.size(), sphere.size());
    for _ in 0..frames {
        znbrdf.decode_into(&code.code, &mut place)?;
        sphere.render_into(place.as_ref(), &mut image);
    }
    println!("{:?}", image.get(64, 64));
    Ok(())
}
