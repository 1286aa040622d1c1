//! Rays and where they end. In f64, so that shadows begin where surfaces do.

use glam::DVec3;

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Along the ray.
    pub distance: f64,
    /// Unit normal to shade with, on the side the ray comes from.
    pub normal: DVec3,
    /// Unit normal of the surface itself, on the same side.
    pub geometric: DVec3,
}

/// How far off a surface a ray starts, in sizes of the numbers that its place is made of; units do not matter.
const OFF: f64 = 1e-7;

impl Ray {
    /// The place at a distance.
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + distance * self.direction
    }

    /// A ray that leaves where this one has hit: it starts a little above, so as not to meet the same surface again.
    pub fn leaving(&self, hit: &Hit, direction: DVec3) -> Self {
        let place = self.at(hit.distance);
        let side = if hit.geometric.dot(direction) < 0.0 { -hit.geometric } else { hit.geometric };
        Self { origin: place + side * (OFF * (hit.distance + place.abs().max_element())), direction }
    }
}

impl Hit {
    /// Of a surface with one normal; turned to where the ray comes from.
    pub fn flat(ray: &Ray, distance: f64, normal: DVec3) -> Self {
        Self::smooth(ray, distance, normal, normal)
    }

    /// Of a surface that is shaded with another normal than its own, unless that one is seen from behind.
    pub fn smooth(ray: &Ray, distance: f64, normal: DVec3, geometric: DVec3) -> Self {
        let towards = |n: DVec3| if n.dot(ray.direction) > 0.0 { -n } else { n };
        let geometric = towards(geometric);
        let normal = if normal.dot(geometric) < 0.0 { -normal } else { normal };
        let is_seen = normal.dot(ray.direction) < 0.0;
        Self { distance, normal: if is_seen { normal } else { geometric }, geometric }
    }
}
