//! The built-in environment: a photographer's dim room with soft boxes, made and not measured.

use glam::DVec3;

use super::{Environment, LatLong};
use crate::{Image, Rgb};

const WIDTH: usize = 512;
const HEIGHT: usize = 256;
/// Radiance of the room below, at the horizon and above, with a smooth passage between.
const FLOOR: DVec3 = DVec3::new(0.045, 0.040, 0.035);
const HORIZON: DVec3 = DVec3::new(0.27, 0.27, 0.29);
const CEILING: DVec3 = DVec3::new(0.10, 0.11, 0.13);
/// Share of a box's half width over which its light fades towards the frame.
const FADE: f64 = 0.12;

/// A rectangle at distance 1, facing the sphere, one edge level.
struct SoftBox {
    /// Towards its middle, in view space.
    towards: DVec3,
    half_width: f64,
    half_height: f64,
    radiance: DVec3,
}

const BOXES: [SoftBox; 4] = [
    // The key: large, warm, from the upper left in front.
    SoftBox {
        towards: DVec3::new(-0.65, 0.5, 0.75),
        half_width: 0.5,
        half_height: 0.5,
        radiance: DVec3::new(4.4, 4.1, 3.7),
    },
    // The strip: tall and cool, on the right, somewhat behind.
    SoftBox {
        towards: DVec3::new(0.97, 0.05, -0.2),
        half_width: 0.18,
        half_height: 0.75,
        radiance: DVec3::new(4.0, 4.5, 5.2),
    },
    // The top light: wide, behind and above, for the rim.
    SoftBox {
        towards: DVec3::new(0.1, 0.85, -0.55),
        half_width: 0.7,
        half_height: 0.25,
        radiance: DVec3::new(4.0, 4.0, 4.0),
    },
    // The spot: small and very bright, from the right in front.
    SoftBox {
        towards: DVec3::new(0.5, 0.55, 0.8),
        half_width: 0.035,
        half_height: 0.035,
        radiance: DVec3::new(240.0, 228.0, 212.0),
    },
];

impl Environment {
    /// A dim room with a large soft box on the upper left, a strip on the right, a top light behind and a small, very
    /// bright spot: 512 × 256 pixels, the same bits for everyone on one kind of machine.
    pub fn softboxes() -> Self {
        let shape = LatLong { width: WIDTH, height: HEIGHT };
        let pixel = |i: usize| radiance(shape.direction(i % WIDTH, i / WIDTH, [0.5; 2]));
        Self::of(Image::new(WIDTH, HEIGHT, (0..WIDTH * HEIGHT).map(pixel).collect()))
    }
}

fn radiance(direction: DVec3) -> Rgb {
    let away = if direction.y > 0.0 { CEILING } else { FLOOR };
    let room = HORIZON.lerp(away, smooth(direction.y.abs()));
    let lit = BOXES.iter().map(|soft_box| soft_box.radiance * soft_box.share(direction));
    Rgb(lit.fold(room, |sum, light| sum + light).as_vec3().to_array())
}

impl SoftBox {
    /// How much of its radiance is seen in a direction: 1 within, 0 without.
    fn share(&self, direction: DVec3) -> f64 {
        let middle = self.towards.normalize();
        let right = DVec3::Y.cross(middle).normalize();
        let up = middle.cross(right);
        let depth = direction.dot(middle);
        if depth <= 0.0 {
            return 0.0;
        }
        let inside = |across: DVec3, half: f64| smooth((1.0 - (direction.dot(across) / (depth * half)).abs()) / FADE);
        inside(right, self.half_width) * inside(up, self.half_height)
    }
}

/// 0 below 0, 1 above 1, 3t² − 2t³ between.
fn smooth(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vec3;

    #[test]
    fn the_key_is_seen_on_the_upper_left_and_the_spot_is_the_brightest() {
        let room = Environment::softboxes();
        assert!(room.radiance(Vec3::new(-0.65, 0.5, 0.75).normalize()).min() > 3.5);
        assert!(room.radiance(Vec3::new(0.5, 0.55, 0.8).normalize()).min() > 200.0);
        assert!(room.radiance(Vec3::new(-0.65, -0.5, 0.75).normalize()).max() < 0.3, "nothing below");
    }

    #[test]
    fn a_white_surface_facing_the_viewer_is_lit_to_about_one() {
        let room = Environment::softboxes();
        let shape = LatLong { width: WIDTH, height: HEIGHT };
        let mut sum = 0.0;
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let cos = shape.direction(x, y, [0.5; 2]).z.max(0.0);
                sum += f64::from(room.map().get(x, y)[1]) * cos * shape.solid_angle(y);
            }
        }
        let shown = sum / std::f64::consts::PI;
        assert!((0.5..1.2).contains(&shown), "{shown}");
    }
}
