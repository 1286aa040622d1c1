//! Reflectances along a line of directions.

use std::f32::consts::{FRAC_PI_2, PI};

use nbrdf_core::metric::directional_albedo;
use nbrdf_core::sampling::evaluate;
use nbrdf_core::{Brdf, Directions, Rgb, Rusinkiewicz};

use super::Subject;
use crate::worker::Card;

/// Steps of the half vector from 0° to 90°, dense at the highlight as tables of measurements are.
const HALF_STEPS: u16 = 180;
/// Last view of an albedo \[degrees\]: beyond, quadrature says little.
const LAST: u16 = 85;

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Whose.
    pub card: Card,
    /// Angles \[degrees\] and what is found there.
    pub points: Vec<(f32, Rgb)>,
}

/// A curve of every subject; none if something newer came.
pub(super) fn of(
    subjects: &[Subject],
    has_news: &dyn Fn() -> bool,
    curve: impl Fn(&dyn Brdf) -> Vec<(f32, Rgb)>,
) -> Option<Vec<Profile>> {
    let one = |Subject { card, brdf, .. }: &Subject| {
        (!has_news()).then(|| Profile { card: *card, points: curve(brdf.as_ref()) })
    };
    subjects.iter().map(one).collect()
}

/// f_r \[1/sr\] over the view's angle from the normal in the plane of incidence, −89° to 89°: the light stands at −`theta_i`,
/// its mirror direction is at +`theta_i` \[degrees\].
pub(super) fn lobe(brdf: &dyn Brdf, theta_i: f32) -> Vec<(f32, Rgb)> {
    let angles = (-178i16..=178).map(|half| 0.5 * f32::from(half));
    along(brdf, angles.map(|theta| (theta, in_plane(theta_i, theta))))
}

fn in_plane(theta_i: f32, theta_o: f32) -> Directions {
    let azimuth = if theta_o < 0.0 { PI } else { 0.0 };
    Directions::from_angles(theta_i.to_radians(), PI, theta_o.abs().to_radians(), azimuth)
}

/// f_r \[1/sr\] over the half vector's polar angle, light and view `theta_d` \[degrees\] beside it, across its plane with the
/// normal (φ_d = 90°); where both are above the surface.
pub(super) fn half(brdf: &dyn Brdf, theta_d: f32) -> Vec<(f32, Rgb)> {
    let angle = |step: u16| 90.0 * (f32::from(step) / f32::from(HALF_STEPS)).powi(2);
    let pairs = (0..=HALF_STEPS).map(angle).map(|theta_h| (theta_h, across(theta_h, theta_d)));
    along(brdf, pairs.filter(|(_, at)| at.is_above()))
}

/// Light and view on both sides of the half vector, across its plane with the normal \[degrees\].
pub(super) fn across(theta_h: f32, theta_d: f32) -> Directions {
    let (theta_half, theta_diff) = (theta_h.to_radians(), theta_d.to_radians());
    Rusinkiewicz { theta_half, theta_diff, phi_diff: FRAC_PI_2, phi_half: 0.0 }.directions()
}

fn along(brdf: &dyn Brdf, pairs: impl Iterator<Item = (f32, Directions)>) -> Vec<(f32, Rgb)> {
    let (angles, at): (Vec<f32>, Vec<Directions>) = pairs.unzip();
    angles.into_iter().zip(evaluate(brdf, &at)).collect()
}

/// Directional albedo over the view's polar angle \[degrees\].
pub(super) fn albedo(brdf: &dyn Brdf, is_fine: bool) -> Vec<(f32, Rgb)> {
    let angles = (0..=LAST).step_by(if is_fine { 1 } else { 5 }).map(f32::from);
    angles.map(|theta| (theta, directional_albedo(brdf, theta.to_radians()))).collect()
}

#[cfg(test)]
mod tests {
    use nbrdf_core::brdf::ggx::Ggx;
    use nbrdf_core::brdf::lambert::Lambert;

    use super::*;

    #[test]
    fn the_lobe_points_where_a_mirror_would() {
        let glossy = Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(0.9), alpha: 0.05 };
        let points = lobe(&glossy, 30.0);
        let peak = points.iter().max_by(|a, b| a.1.max().total_cmp(&b.1.max())).unwrap();
        assert!((peak.0 - 30.0).abs() <= 1.0, "{peak:?}");
        let highlight = half(&glossy, 20.0);
        assert!(highlight.windows(2).all(|pair| pair[1].0 > pair[0].0));
        assert!(highlight[0].1.max() > 100.0 * highlight[100].1.max());
    }

    #[test]
    fn a_white_surface_has_its_albedo_wherever_one_stands() {
        let grey = Lambert { albedo: Rgb::splat(0.5) };
        let points = albedo(&grey, false);
        assert_eq!(points.len(), 18);
        assert!(points.iter().all(|(_, albedo)| (albedo.max() - 0.5).abs() < 1e-3), "{points:?}");
    }
}
