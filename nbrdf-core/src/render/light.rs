//! Directional lights: smooth and exact, so that a figure measured under them means the same everywhere.

use std::f32::consts::PI;

use glam::{DVec3, Vec3};

use crate::Rgb;

/// A set of directional lights around the sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name in reports and on the command line: `point`, `studio`, `directional`.
    pub name: &'static str,
    /// The lights that are on.
    pub lamps: Vec<Lamp>,
}

/// One directional light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Unit vector towards the lamp, in view space: +x right, +y up, +z towards the viewer.
    pub direction: Vec3,
    /// On a surface facing the lamp; under π a white Lambertian facing it shows 1.
    pub irradiance: Rgb,
}

impl Light {
    /// Names that [`by_name`](Self::by_name) knows.
    pub const NAMES: [&'static str; 2] = ["point", "studio"];

    /// One lamp of irradiance π at 45° to the right of the viewer.
    pub fn point() -> Self {
        Self { name: "point", lamps: vec![lamp(DVec3::new(1.0, 0.0, 1.0), [1.0; 3])] }
    }

    /// One lamp of irradiance π in the given direction (normalised here), which must not be zero.
    pub fn directional(direction: Vec3) -> Self {
        Self { name: "directional", lamps: vec![lamp(direction.as_dvec3(), [1.0; 3])] }
    }

    /// A warm, a cool and a neutral key, and a ring of eight weak fills, which keeps highlights on the whole sphere.
    ///
    /// Fill k of 0..7 stands at azimuth 45° k around the view axis, from +x towards +y, and 75° (k even) or
    /// 50° (k odd) away from that axis.
    pub fn studio() -> Self {
        let keys = [
            ([0.5, 0.6, 0.8], [0.75, 0.72, 0.68]),
            ([-0.7, 0.3, 0.6], [0.25, 0.28, 0.32]),
            ([0.1, -0.5, 0.9], [0.15; 3]),
        ];
        let fill = |k: u32| {
            let (sin_azimuth, cos_azimuth) = f64::from(45 * k).to_radians().sin_cos();
            let (sin, cos) = if k.is_multiple_of(2) { 75_f64 } else { 50_f64 }.to_radians().sin_cos();
            lamp(DVec3::new(sin * cos_azimuth, sin * sin_azimuth, cos), [0.03; 3])
        };
        let keys = keys.into_iter().map(|(direction, share)| lamp(DVec3::from_array(direction), share));
        Self { name: "studio", lamps: keys.chain((0..8).map(fill)).collect() }
    }

    /// The light of this name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        match name {
            "point" => Some(Self::point()),
            "studio" => Some(Self::studio()),
            _ => None,
        }
    }
}

/// `share`: irradiance in units of π.
fn lamp(direction: DVec3, share: [f32; 3]) -> Lamp {
    Lamp { direction: direction.normalize().as_vec3(), irradiance: Rgb(share) * PI }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_known_and_carried() {
        for name in Light::NAMES {
            assert_eq!(Light::by_name(name).unwrap().name, name);
        }
        assert!(Light::by_name("sunset").is_none());
    }

    #[test]
    fn the_studio_has_eleven_unit_lamps() {
        let studio = Light::studio();
        assert_eq!(studio.lamps.len(), 11);
        assert!(studio.lamps.iter().all(|lamp| (lamp.direction.length() - 1.0).abs() < 1e-6));
        let total = studio.lamps.iter().fold(Rgb::BLACK, |sum, lamp| sum + lamp.irradiance * PI.recip());
        assert!(total.zip(Rgb([1.39; 3]), |a, b| (a - b).abs()).max() < 1e-5, "{total:?}");
    }

    #[test]
    fn the_first_fill_is_on_the_right_and_the_third_above() {
        let lamps = Light::studio().lamps;
        assert!(lamps[3].direction.x > 0.9 && lamps[3].direction.y.abs() < 1e-6);
        assert!(lamps[5].direction.y > 0.9 && lamps[5].direction.x.abs() < 1e-6);
    }
}
