//! What objects are made of: spheres, planes, rectangles, meshes. All are seen from both sides.

use std::sync::Arc;

use glam::DVec3;

use super::{Hit, Mesh, Ray};

/// A surface.
#[derive(Clone, Debug)]
pub enum Shape {
    /// All places at a distance.
    Sphere {
        /// Its middle.
        centre: DVec3,
        /// That distance, above 0.
        radius: f64,
    },
    /// Without end.
    Plane {
        /// A place on it.
        point: DVec3,
        /// Unit vector.
        normal: DVec3,
    },
    /// centre + a u + b v, a and b in −1..1.
    Rectangle {
        /// Its middle.
        centre: DVec3,
        /// Half an edge.
        u: DVec3,
        /// Half the other edge, at a right angle.
        v: DVec3,
    },
    /// Triangles.
    Mesh(Arc<Mesh>),
}

impl Shape {
    /// The first hit along a ray, nearer than `limit`.
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        match self {
            Self::Sphere { centre, radius } => {
                let distance = sphere(ray, *centre, *radius, limit)?;
                Some(Hit::flat(ray, distance, (ray.at(distance) - *centre) / *radius))
            }
            Self::Plane { point, normal } => {
                let distance = plane(ray, *point, *normal, limit)?;
                Some(Hit::flat(ray, distance, *normal))
            }
            Self::Rectangle { centre, u, v } => {
                let (distance, normal) = rectangle(ray, [*centre, *u, *v], limit)?;
                Some(Hit::flat(ray, distance, normal))
            }
            Self::Mesh(mesh) => mesh.hit(ray, limit),
        }
    }

    /// Its middle; of a plane the place that it was given by.
    pub fn centre(&self) -> DVec3 {
        match self {
            Self::Sphere { centre, .. } | Self::Rectangle { centre, .. } => *centre,
            Self::Plane { point, .. } => *point,
            Self::Mesh(mesh) => mesh.centre(),
        }
    }
}

/// The nearer root that is in front. With the foot of the perpendicular instead of the middle, large and far spheres
/// keep their digits (E. Haines et al., *Precision Improvements for Ray/Sphere Intersection*, Ray Tracing Gems 2019).
fn sphere(ray: &Ray, centre: DVec3, radius: f64, limit: f64) -> Option<f64> {
    let to_origin = ray.origin - centre;
    let along = -to_origin.dot(ray.direction);
    let foot = to_origin + along * ray.direction;
    let half = (radius * radius - foot.length_squared()).max(-1.0);
    if half <= 0.0 {
        return None;
    }
    let half = half.sqrt();
    [along - half, along + half].into_iter().find(|&distance| distance > 0.0).filter(|&distance| distance < limit)
}

fn plane(ray: &Ray, point: DVec3, normal: DVec3, limit: f64) -> Option<f64> {
    let distance = normal.dot(point - ray.origin) / normal.dot(ray.direction);
    // A ray along the plane gives NaN or infinity, neither of which is in front and near.
    (distance > 0.0 && distance < limit && distance.is_finite()).then_some(distance)
}

/// Where a ray meets centre + a u + b v, a and b in −1..1, and the normal u × v there.
pub(super) fn rectangle(ray: &Ray, [centre, u, v]: [DVec3; 3], limit: f64) -> Option<(f64, DVec3)> {
    let normal = u.cross(v).normalize();
    let distance = plane(ray, centre, normal, limit)?;
    let place = ray.at(distance) - centre;
    let is_within = |edge: DVec3| place.dot(edge).abs() <= edge.length_squared();
    (is_within(u) && is_within(v)).then_some((distance, normal))
}
