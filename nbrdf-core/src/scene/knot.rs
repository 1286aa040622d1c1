//! A trefoil knot: every curvature, light from every side, and shadows of its own.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{Mesh, Triangle};

/// Steps along the knot and around it.
const ALONG: usize = 224;
const AROUND: usize = 28;
/// Radius of the tube, where the knot winds around a torus of radii 2 and 1.
const THICKNESS: f64 = 0.52;

impl Mesh {
    /// A trefoil knot of 12 544 triangles, seen best along z.
    pub fn knot() -> Self {
        let triangles = (0..ALONG * AROUND).flat_map(|i| {
            let (along, around) = (i / AROUND, i % AROUND);
            let corner = |da: usize, db: usize| tube((along + da) % ALONG, (around + db) % AROUND);
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            [[a, b, c], [a, c, d]].map(|corners| Triangle {
                corners: corners.map(|(place, _)| place),
                normals: corners.map(|(_, normal)| normal),
            })
        });
        Self::new(triangles.collect())
    }
}

/// Place and normal.
fn tube(along: usize, around: usize) -> (DVec3, DVec3) {
    let angle = TAU * along as f64 / ALONG as f64;
    let ((sin2, cos2), (sin3, cos3)) = ((2.0 * angle).sin_cos(), (3.0 * angle).sin_cos());
    let out = 2.0 + cos3;
    let middle = DVec3::new(out * cos2, out * sin2, sin3);
    // The torus' normal is across the knot, everywhere.
    let first = DVec3::new(cos3 * cos2, cos3 * sin2, sin3);
    let tangent = DVec3::new(-3.0 * sin3 * cos2 - 2.0 * out * sin2, -3.0 * sin3 * sin2 + 2.0 * out * cos2, 3.0 * cos3);
    let second = tangent.normalize().cross(first);
    let (sin, cos) = (TAU * around as f64 / AROUND as f64).sin_cos();
    let normal = cos * first + sin * second;
    (middle + THICKNESS * normal, normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_unit_vectors_and_lean_as_the_faces_do() {
        for (along, around) in [(0, 0), (50, 7), (223, 27), (111, 14)] {
            let [(a, normal), (b, _), (c, _)] =
                [tube(along, around), tube((along + 1) % ALONG, around), tube(along, (around + 1) % AROUND)];
            let face = (b - a).cross(c - a).normalize();
            assert!((normal.length() - 1.0).abs() < 1e-12);
            assert!(face.dot(normal).abs() > 0.98, "{along} {around}: {}", face.dot(normal));
        }
    }

    #[test]
    fn the_knot_is_round_a_middle() {
        let knot = Mesh::knot();
        assert_eq!(knot.len(), 2 * ALONG * AROUND);
        assert!(knot.centre().length() < 0.5 && knot.radius() > 3.0 && knot.radius() < 4.0, "{}", knot.radius());
    }
}
