//! Material, fit, and how far they are apart, side by side on spheres.

use nbrdf_core::metric::{delta_e_itp, delta_e_itp_map};
use nbrdf_core::render::{Light, Sphere};
use nbrdf_core::{Brdf, Image, Material};

use crate::report::heat::heat;
use crate::strip::text::{Face, Text};

/// Pixels of a sphere, and of the gap and the line of text below.
const SIZE: usize = 256;
const GAP: usize = 8;
const LINE: usize = 28;
/// Ends of the map's scale: the first that the largest difference does not exceed.
const TOPS: [f64; 7] = [5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0];

/// Under light `studio`; the map shows ΔE_ITP from black to white.
pub(super) fn difference(material: &Material, fit: &dyn Brdf, model: &str) -> Image {
    let sphere = Sphere::new(SIZE, &Light::studio());
    let [known, own] = [material.brdf.as_ref(), fit].map(|brdf| sphere.render(brdf));
    let apart = delta_e_itp_map(&known, &own);
    let largest = apart.iter().copied().fold(0.0, f32::max);
    let top = TOPS.into_iter().find(|top| f64::from(largest) <= *top).unwrap_or(f64::from(largest));
    let map = Image::new(SIZE, SIZE, apart.iter().map(|apart| heat(f64::from(*apart) / top)).collect());
    let mean = delta_e_itp(&known, &own, sphere.covered());
    let labels = [material.name.clone(), format!("fit: {model}"), format!("ΔE ITP, white is {top:.0}; mean {mean:.1}")];
    let spheres = Image::beside(&[known, own, map], GAP);
    let mut picture = Image::stacked(&[spheres, Image::black(1, LINE)], 0);
    for (place, label) in labels.iter().enumerate() {
        let text = Text::new(Face::Sans, 16.0);
        text.draw(&mut picture, label, (place * (SIZE + GAP) + GAP) as f32, (SIZE + LINE - 9) as f32, 0.8);
    }
    picture
}
