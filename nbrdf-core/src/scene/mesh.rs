//! Triangles, found through a bounding volume hierarchy.

use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::BHShape;
use bvh::bvh::Bvh;
use bvh::flat_bvh::FlatNode;
use glam::DVec3;
use nalgebra::Point3;

use super::{Hit, Ray};

/// Triangles with a normal at every corner.
pub struct Mesh {
    triangles: Vec<Triangle>,
    nodes: Vec<FlatNode<f64, 3>>,
    centre: DVec3,
    radius: f64,
}

/// Three corners, counter-clockwise where it is seen from the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Places.
    pub corners: [DVec3; 3],
    /// Unit normals to shade with.
    pub normals: [DVec3; 3],
}

/// A triangle while the hierarchy is built.
struct Leaf {
    bounds: Aabb<f64, 3>,
    node: usize,
}

impl Bounded<f64, 3> for Leaf {
    fn aabb(&self) -> Aabb<f64, 3> {
        self.bounds
    }
}

impl BHShape<f64, 3> for Leaf {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

fn point(at: DVec3) -> Point3<f64> {
    Point3::new(at.x, at.y, at.z)
}

fn vector(at: &Point3<f64>) -> DVec3 {
    DVec3::new(at.x, at.y, at.z)
}

impl Mesh {
    /// Of these triangles, finite and at least one.
    pub fn new(triangles: Vec<Triangle>) -> Self {
        let bounds = |corners: &[DVec3; 3]| {
            let (low, high) = corners.iter().fold((corners[0], corners[0]), |(l, h), c| (l.min(*c), h.max(*c)));
            Aabb::with_bounds(point(low), point(high))
        };
        let mut leaves: Vec<Leaf> =
            triangles.iter().map(|triangle| Leaf { bounds: bounds(&triangle.corners), node: 0 }).collect();
        let nodes = Bvh::build(&mut leaves).flatten();
        let (low, high) = triangles
            .iter()
            .flat_map(|triangle| triangle.corners)
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), corner| (low.min(corner), high.max(corner)));
        let centre = 0.5 * (low + high);
        let corners = triangles.iter().flat_map(|triangle| triangle.corners);
        let radius = corners.fold(0.0, |most: f64, corner| most.max(corner.distance(centre)));
        Self { triangles, nodes, centre, radius }
    }

    /// How many triangles.
    pub const fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Middle of its bounds.
    pub const fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Largest distance of a corner from the middle.
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// The first hit along a ray, nearer than `limit`.
    pub(crate) fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let mut found = None;
        self.walk(ray, limit, |distance, weights, triangle| {
            found = Some((distance, weights, triangle));
            false
        });
        let (distance, weights, triangle) = found?;
        Some(Hit::smooth(ray, distance, triangle.normal_at(weights), triangle.geometric()))
    }

    /// Whether a ray meets anything.
    pub(crate) fn is_met(&self, ray: &Ray) -> bool {
        let mut is_met = false;
        self.walk(ray, f64::INFINITY, |_, _, _| {
            is_met = true;
            true
        });
        is_met
    }

    /// Tells of hits, each nearer than the one before, until `tell` has enough. The flat hierarchy is walked without a
    /// stack: a box that is missed, or farther than what was found, leads past everything in it.
    fn walk<'a>(&'a self, ray: &Ray, limit: f64, mut tell: impl FnMut(f64, DVec3, &'a Triangle) -> bool) {
        let inverse = ray.direction.recip();
        let mut nearest = limit;
        let mut index = 0;
        while let Some(node) = self.nodes.get(index) {
            if node.is_leaf() {
                let triangle = self.triangles.get(node.shape_index as usize);
                if let Some((distance, weights, triangle)) =
                    triangle.and_then(|triangle| triangle.hit(ray, nearest).map(|(d, w)| (d, w, triangle)))
                {
                    nearest = distance;
                    if tell(distance, weights, triangle) {
                        return;
                    }
                }
                index = node.exit_index as usize;
            } else if is_crossed(&node.aabb, ray.origin, inverse, nearest) {
                index = node.entry_index as usize;
            } else {
                index = node.exit_index as usize;
            }
        }
    }
}

impl std::fmt::Debug for Mesh {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Mesh of {} triangles", self.triangles.len())
    }
}

/// Whether a box is entered before `limit`. A ray within the plane of a face divides 0 by 0: along that axis it is within.
fn is_crossed(bounds: &Aabb<f64, 3>, origin: DVec3, inverse: DVec3, limit: f64) -> bool {
    let (a, b) = ((vector(&bounds.min) - origin) * inverse, (vector(&bounds.max) - origin) * inverse);
    let mut range = (0.0_f64, limit);
    for axis in 0..3 {
        if a[axis].is_nan() || b[axis].is_nan() {
            continue;
        }
        range = (range.0.max(a[axis].min(b[axis])), range.1.min(a[axis].max(b[axis])));
    }
    range.0 <= range.1
}

impl Triangle {
    /// Distance, and the weights of the corners (T. Möller, B. Trumbore, *Fast, Minimum Storage Ray/Triangle
    /// Intersection*, 1997).
    fn hit(&self, ray: &Ray, limit: f64) -> Option<(f64, DVec3)> {
        let [a, b, c] = self.corners;
        let (ab, ac) = (b - a, c - a);
        let across = ray.direction.cross(ac);
        let scale = across.dot(ab).recip();
        let from = ray.origin - a;
        let v = across.dot(from) * scale;
        let along = from.cross(ab);
        let w = along.dot(ray.direction) * scale;
        let distance = along.dot(ac) * scale;
        // Written so that NaN, of rays within the triangle's plane, is no hit.
        let is_hit = v >= 0.0 && w >= 0.0 && v + w <= 1.0 && distance > 0.0 && distance < limit;
        is_hit.then(|| (distance, DVec3::new(1.0 - v - w, v, w)))
    }

    fn normal_at(&self, weights: DVec3) -> DVec3 {
        let [a, b, c] = self.normals;
        (weights.x * a + weights.y * b + weights.z * c).try_normalize().unwrap_or_else(|| self.geometric())
    }

    fn geometric(&self) -> DVec3 {
        let [a, b, c] = self.corners;
        (b - a).cross(c - a).normalize_or(DVec3::Y)
    }
}
