//! Image slices: f_r over half and difference angles, all at once (B. Burley, *Physically Based Shading at Disney*, 2012).

use std::f32::consts::PI;

use nbrdf_core::sampling::evaluate;
use nbrdf_core::{Brdf, Directions, Image, Rgb};

use super::Subject;
use super::profile::across;
use crate::worker::{Card, Picture};

/// Pixels per side: nearly one a degree.
const SIDE: usize = 90;

/// The slice of every subject; none if something newer came.
pub(super) fn of(subjects: &[Subject], exposure: f32, has_news: &dyn Fn() -> bool) -> Option<Vec<(Card, Picture)>> {
    let at = places();
    let one =
        |Subject { card, brdf, .. }: &Subject| (!has_news()).then(|| (*card, picture(brdf.as_ref(), &at, exposure)));
    subjects.iter().map(one).collect()
}

/// θ_half from the left, θ_diff from below, 0° to 90° at the pixels' centres.
fn places() -> Vec<Directions> {
    let angle = |pixel: usize| 90.0 * (pixel as f32 + 0.5) / SIDE as f32;
    (0..SIDE * SIDE).map(|pixel| across(angle(pixel % SIDE), angle(SIDE - 1 - pixel / SIDE))).collect()
}

/// π f_r, so that a white diffuse surface is white. Across the half vector's plane (φ_d = 90°) light and view are above the
/// surface all over.
fn picture(brdf: &dyn Brdf, at: &[Directions], exposure: f32) -> Picture {
    let pixels: Vec<Rgb> = evaluate(brdf, at).into_iter().map(|f| f * PI).collect();
    let mut opaque = Vec::new();
    Image::new(SIDE, SIDE, pixels).display_bytes_into(exposure.exp2(), &mut opaque);
    let rgba = opaque.chunks_exact(3).flat_map(|rgb| [rgb[0], rgb[1], rgb[2], 255]);
    Picture { size: SIDE, rgba: rgba.collect() }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::brdf::ggx::Ggx;
    use nbrdf_core::brdf::lambert::Lambert;

    use super::*;

    #[test]
    fn white_is_white_all_over() {
        let shown = picture(&Lambert { albedo: Rgb::splat(1.0) }, &places(), 0.0);
        assert_eq!((shown.size, shown.rgba.len()), (SIDE, 4 * SIDE * SIDE));
        assert!(shown.rgba.iter().all(|&byte| byte >= 254), "{:?}", shown.rgba.iter().min());
    }

    #[test]
    fn the_highlight_is_on_the_left_and_brightens_upwards() {
        let shown = picture(&Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(0.04), alpha: 0.3 }, &places(), -4.0);
        let pixel = |x: usize, y: usize| shown.rgba[4 * (y * SIDE + x)];
        assert!(pixel(0, SIDE - 1) > pixel(SIDE / 2, SIDE - 1));
        assert!(pixel(0, 5) > pixel(0, SIDE - 1), "Fresnel: grazing light is reflected");
    }
}
