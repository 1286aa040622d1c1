//! The worst example as a small picture: spheres beside each other, and what is different.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use nbrdf_core::metric::flip_map;
use nbrdf_core::render::{Light, Sphere};
use nbrdf_core::{Image, Rgb, Vec3};

use super::tally::Look;
use crate::report::heat::heat;

/// Pixels of a sphere's side, and between two.
const SIZE: usize = 56;
const GAP: usize = 4;
/// FLIP that is white.
const WHITE: f32 = 0.3;

/// How reflectances are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Under the standard lights.
    Studio,
    /// Under a lamp from the side and a little behind: grazing light, and a bright rim.
    Rim,
    /// Ends and what is between: no difference is drawn.
    Walk,
}

/// The picture as PNG, in base 64.
pub(super) fn base64(look: &Look) -> Option<String> {
    let light = match look.view {
        View::Rim => Light::directional(Vec3::new(0.98, 0.0, -0.17)),
        View::Studio | View::Walk => Light::studio(),
    };
    let sphere = Sphere::new(SIZE, &light);
    let mut panels: Vec<Image> = look.panels.iter().map(|(_, brdf)| sphere.render(brdf.as_ref())).collect();
    if let ([wanted, found], View::Studio | View::Rim) = (panels.as_slice(), look.view) {
        let map = flip_map(&wanted.displayed(), &found.displayed());
        let pixels: Vec<Rgb> = map.iter().map(|&error| heat(f64::from(error / WHITE))).collect();
        panels.push(Image::new(SIZE, SIZE, pixels));
    }
    Some(STANDARD.encode(Image::beside(&panels, GAP).png_bytes().ok()?))
}
