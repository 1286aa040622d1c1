//! What a material is seen on: a sphere, a plane, a mesh; each fitted into the picture.
//!
//! View space is that of lights: +x right, +y up, +z towards the viewer, who looks at the middle of the picture.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::surface::Surface;
use crate::scene::{Mesh, Ray};

/// Radius of the sphere in half image widths.
pub(super) const RADIUS: f64 = 0.99;
/// The plane is looked down upon at this angle \[rad\], half a right one: the picture reaches from 5° to 85° below the
/// horizon.
const PLANE_PITCH: f64 = PI / 4.0;
/// tan 40°, half the plane's field of view.
const PLANE_FIELD: f64 = 0.839_099_631_177_28;
/// A mesh is seen from this far above \[rad\], 20°.
const MESH_PITCH: f64 = PI / 9.0;
/// And from this far aside \[rad\], 25°: boxes show two sides.
const MESH_YAW: f64 = 25.0 / 180.0 * PI;
/// Half of a mesh's field of view \[rad\], 15°.
const MESH_FIELD: f64 = PI / 12.0;

/// A surface in a picture.
#[derive(Clone, Debug, Default)]
pub enum Model {
    /// Of 0.99 half image widths, seen from afar (orthographic).
    #[default]
    Sphere,
    /// A ground without end, seen aslant in perspective: 5° below the horizon at the top, 85° at the bottom.
    Plane,
    /// Triangles in perspective, from 20° above. Its bounding sphere has the size of the sphere; it shadows itself.
    Mesh(Arc<Mesh>),
}

/// Meshes are the same if they are one in memory.
impl PartialEq for Model {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Sphere, Self::Sphere) | (Self::Plane, Self::Plane) => true,
            (Self::Mesh(one), Self::Mesh(other)) => Arc::ptr_eq(one, other),
            _ => false,
        }
    }
}

impl Model {
    /// What is seen at a place of the whole picture, \[across, up\] in −1..1; none beside the surface.
    pub fn surface(&self, [across, up]: [f64; 2]) -> Option<Surface> {
        match self {
            Self::Sphere => {
                let (x, y) = (across / RADIUS, up / RADIUS);
                let z2 = 1.0 - x * x - y * y;
                (z2 > 0.0).then(|| Surface::lone(DVec3::new(x, y, z2.sqrt()), DVec3::Z))
            }
            Self::Plane => {
                let towards = DVec3::new(PLANE_FIELD * across, PLANE_FIELD * up, -1.0);
                let normal = plane_normal();
                (towards.dot(normal) < 0.0).then(|| Surface::lone(normal, -towards.normalize()))
            }
            Self::Mesh(mesh) => seen(mesh, across, up),
        }
    }

    /// The direction that is mirrored to the viewer at a place of the whole picture. Of a mesh, the sphere's in its
    /// place: what its folds mirror changes too quickly to follow.
    pub fn mirrored(&self, place: [f64; 2]) -> Option<DVec3> {
        let surface = self.smooth().surface(place)?;
        Some(2.0 * surface.normal.dot(surface.view) * surface.normal - surface.view)
    }

    /// Where a mirror would show what is in this direction (a unit vector), as [`mirrored`](Self::mirrored) has it; none
    /// where it would not.
    pub fn mirror(&self, direction: DVec3) -> Option<[f64; 2]> {
        match self.smooth() {
            Self::Plane => {
                let normal = plane_normal();
                let view = 2.0 * normal.dot(direction) * normal - direction;
                let is_seen = view.z > 1e-6 && normal.dot(view) > 0.0;
                is_seen.then(|| [-view.x / view.z / PLANE_FIELD, -view.y / view.z / PLANE_FIELD])
            }
            _ => {
                let half = (direction + DVec3::Z).try_normalize()?;
                Some([half.x * RADIUS, half.y * RADIUS])
            }
        }
    }

    /// Itself, or the sphere in place of a mesh.
    const fn smooth(&self) -> &Self {
        match self {
            Self::Mesh(_) => &Self::Sphere,
            _ => self,
        }
    }

    /// Whether light from a direction in view space reaches a place of the surface.
    pub(super) fn is_open(&self, surface: &Surface, direction: DVec3) -> bool {
        let Self::Mesh(mesh) = self else { return true };
        surface.geometric.dot(direction) > 0.0 && {
            let direction = to_view().transpose() * direction;
            !mesh.is_met(&Ray { origin: surface.place, direction })
        }
    }
}

/// In view space.
fn plane_normal() -> DVec3 {
    let (sin, cos) = PLANE_PITCH.sin_cos();
    DVec3::new(0.0, cos, sin)
}

/// From the space of a mesh.
fn to_view() -> DMat3 {
    DMat3::from_rotation_x(MESH_PITCH) * DMat3::from_rotation_y(-MESH_YAW)
}

fn seen(mesh: &Mesh, across: f64, up: f64) -> Option<Surface> {
    let to_view = to_view();
    let to_mesh = to_view.transpose();
    // Rays that touch the bounding sphere leave the middle by the angle whose sine is radius by distance.
    let field = MESH_FIELD.tan();
    let distance = mesh.radius() / (RADIUS * field).atan().sin();
    let towards = DVec3::new(field * across, field * up, -1.0).normalize();
    let ray = Ray { origin: mesh.centre() + to_mesh * DVec3::new(0.0, 0.0, distance), direction: to_mesh * towards };
    let hit = mesh.hit(&ray, f64::INFINITY)?;
    Some(Surface {
        normal: to_view * hit.normal,
        view: -towards,
        geometric: to_view * hit.geometric,
        place: ray.leaving(&hit, hit.geometric).origin,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Triangle;

    /// A square that faces the viewer, `half` wide either way.
    fn square(half: f64, away: f64) -> [Triangle; 2] {
        let corner = |x: f64, y: f64| to_view().transpose() * DVec3::new(x * half, y * half, away);
        let (a, b, c, d) = (corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0));
        let normals = [to_view().transpose() * DVec3::Z; 3];
        [Triangle { corners: [a, b, c], normals }, Triangle { corners: [a, c, d], normals }]
    }

    #[test]
    fn a_mesh_fills_the_picture_and_no_more() {
        let model = Model::Mesh(Arc::new(Mesh::new(square(7.0, 3.0).to_vec())));
        let surface = model.surface([0.3, -0.2]).unwrap();
        assert!((surface.normal - DVec3::Z).length() < 1e-9, "{surface:?}");
        // A corner lies on the bounding sphere, across the viewer's direction: a little inside its outline.
        let corner = RADIUS * 0.5_f64.sqrt();
        assert!(model.surface([0.95 * corner; 2]).is_some() && model.surface([1.001 * corner; 2]).is_none());
        assert!(model.surface([0.0, 0.9]).is_none());
    }

    #[test]
    fn a_mesh_shadows_itself() {
        let model = Model::Mesh(Arc::new(Mesh::new([square(1.0, 0.0), square(0.5, -1.0)].concat())));
        // On the small square, behind the large one and beside the edge between its triangles.
        let place = to_view().transpose() * DVec3::new(0.1, 0.2, -0.999);
        let behind = Surface { place, ..Surface::lone(DVec3::Z, DVec3::Z) };
        assert!(!model.is_open(&behind, DVec3::Z));
        assert!(model.is_open(&behind, DVec3::new(0.9, 0.0, 0.1).normalize()));
        assert!(!model.is_open(&behind, DVec3::NEG_Z), "from below");
    }

    #[test]
    fn the_plane_is_seen_from_steep_to_grazing() {
        let elevation = |up: f64| {
            let surface = Model::Plane.surface([0.0, up]).unwrap();
            surface.normal.dot(surface.view).asin().to_degrees()
        };
        assert!((elevation(1.0) - 5.0).abs() < 1e-9 && (elevation(-1.0) - 85.0).abs() < 1e-9);
    }

    #[test]
    fn a_mirror_shows_a_direction_where_it_is_mirrored() {
        for model in [Model::Sphere, Model::Plane] {
            for place in [[0.0, 0.0], [0.3, -0.5], [-0.6, 0.4]] {
                let found = model.mirror(model.mirrored(place).unwrap()).unwrap();
                assert!((found[0] - place[0]).abs() < 1e-9 && (found[1] - place[1]).abs() < 1e-9, "{found:?}");
            }
        }
        assert_eq!(Model::Sphere.mirror(DVec3::NEG_Z), None);
        assert_eq!(Model::Plane.mirror(DVec3::Z), None, "what is behind the viewer");
    }
}
