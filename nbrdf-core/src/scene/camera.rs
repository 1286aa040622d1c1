//! A pinhole.

use glam::DVec3;

use super::{Picture, Ray};

/// Where a picture is taken from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole.
    pub from: DVec3,
    /// A place in the middle of the picture.
    pub to: DVec3,
    /// Not along the view.
    pub up: DVec3,
    /// Vertical angle of view \[rad\], below π.
    pub field: f64,
}

impl Camera {
    /// The ray through a place of the picture: `x` in 0..width from the left, `y` in 0..height from the top.
    pub fn ray(&self, picture: &Picture, x: f64, y: f64) -> Ray {
        let forward = (self.to - self.from).normalize();
        let right = forward.cross(self.up).normalize();
        let up = right.cross(forward);
        let (width, height) = (picture.width as f64, picture.height as f64);
        let scale = 2.0 * (0.5 * self.field).tan() / height;
        let direction = forward + right * ((x - 0.5 * width) * scale) + up * ((0.5 * height - y) * scale);
        Ray { origin: self.from, direction: direction.normalize() }
    }

    /// `factor` times as far from a place, which stays where it is in the picture.
    #[must_use]
    pub fn moved_away(self, place: DVec3, factor: f64) -> Self {
        let step = (self.from - place) * (factor - 1.0);
        Self { from: self.from + step, to: self.to + step, ..self }
    }
}
