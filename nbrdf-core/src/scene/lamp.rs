//! What shines: lamps without size, luminous rectangles, light from all around.

use glam::DVec3;

use super::Ray;
use super::shape::rectangle;
use crate::Rgb;
use crate::render::Environment;

/// A light.
#[derive(Clone, Debug)]
pub enum Lamp {
    /// Without size, alike in all directions.
    Point {
        /// Where it is.
        at: DVec3,
        /// Radiant intensity \[W/sr, in units where displayed white is radiance 1\].
        intensity: Rgb,
    },
    /// A rectangle that shines on the side of u × v. It is seen, and nothing is in its way but objects.
    Area {
        /// Its middle.
        centre: DVec3,
        /// Half an edge.
        u: DVec3,
        /// Half the other edge, at a right angle.
        v: DVec3,
        /// Radiance.
        radiance: Rgb,
    },
    /// From all around; at most one.
    Environment {
        /// The map, turned.
        map: Box<Environment>,
        /// What its radiances are multiplied by.
        strength: f64,
        /// Whether the camera sees it where there is nothing else.
        is_seen: bool,
    },
}

/// Light that arrives at a place from one direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arriving {
    /// Unit vector towards the light.
    pub direction: DVec3,
    /// How far away it is.
    pub distance: f64,
    /// Radiance; of a light without size, irradiance of a surface that faces it.
    pub radiance: DVec3,
    /// Density \[1/sr\] with which [`Lamp::draw`] draws it; none where there is only one direction.
    pub pdf: Option<f64>,
}

fn vector(Rgb(rgb): Rgb) -> DVec3 {
    DVec3::from_array(rgb.map(f64::from))
}

impl Lamp {
    /// A direction from which it is seen at a place; none where it turns its back, or is there.
    pub(super) fn draw(&self, place: DVec3, u: [f64; 2]) -> Option<Arriving> {
        match self {
            Self::Point { at, intensity } => {
                let (direction, distance) = towards(*at - place)?;
                let radiance = vector(*intensity) / (distance * distance);
                Some(Arriving { direction, distance, radiance, pdf: None })
            }
            Self::Area { centre, u: a, v: b, radiance } => {
                let on = *centre + (2.0 * u[0] - 1.0) * *a + (2.0 * u[1] - 1.0) * *b;
                let (direction, distance) = towards(on - place)?;
                let pdf = area_pdf(*a, *b, direction, distance)?;
                Some(Arriving { direction, distance, radiance: vector(*radiance), pdf: Some(pdf) })
            }
            Self::Environment { map, strength, .. } => {
                let drawn = map.sample(u);
                let radiance = vector(drawn.radiance) * *strength;
                let direction = drawn.direction.as_dvec3().normalize();
                Some(Arriving { direction, distance: f64::INFINITY, radiance, pdf: Some(drawn.pdf) })
            }
        }
    }

    /// What arrives from a direction; lights without size are never met by chance.
    pub(super) fn look(&self, place: DVec3, direction: DVec3) -> Option<Arriving> {
        match self {
            Self::Point { .. } => None,
            Self::Area { centre, u, v, radiance } => {
                let ray = Ray { origin: place, direction };
                let (distance, _) = rectangle(&ray, [*centre, *u, *v], f64::INFINITY)?;
                let pdf = area_pdf(*u, *v, direction, distance)?;
                Some(Arriving { direction, distance, radiance: vector(*radiance), pdf: Some(pdf) })
            }
            Self::Environment { map, strength, .. } => {
                let seen = map.look(direction.as_vec3());
                let radiance = vector(seen.radiance) * *strength;
                Some(Arriving { direction, distance: f64::INFINITY, radiance, pdf: Some(seen.pdf) })
            }
        }
    }

    /// Whether the camera sees it.
    pub(super) const fn is_seen(&self) -> bool {
        match self {
            Self::Point { .. } => false,
            Self::Area { .. } => true,
            Self::Environment { is_seen, .. } => *is_seen,
        }
    }
}

fn towards(offset: DVec3) -> Option<(DVec3, f64)> {
    let distance = offset.length();
    (distance > 0.0 && distance.is_finite()).then(|| (offset / distance, distance))
}

/// Density over solid angle of an even choice on a rectangle; none from behind.
fn area_pdf(u: DVec3, v: DVec3, direction: DVec3, distance: f64) -> Option<f64> {
    let normal = u.cross(v);
    let area = 4.0 * normal.length();
    let facing = -normal.normalize().dot(direction);
    (facing > 0.0).then(|| distance * distance / (facing * area))
}
