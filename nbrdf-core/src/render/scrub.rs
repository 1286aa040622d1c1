//! A walk as a film: one sphere, one path, frame after frame in the same memory.

use std::sync::Arc;

use super::Sphere;
use crate::path::PathError;
use crate::{Brdf, Image, Path, Weights};

/// A path under a light, ready to be scrubbed. Frames of paths through networks (latent, weights) allocate nothing.
pub struct Scrub {
    sphere: Arc<Sphere>,
    path: Arc<dyn Path>,
    point: Box<dyn Brdf>,
    image: Image,
    bytes: Vec<u8>,
}

impl Scrub {
    /// At these weights.
    pub fn new(sphere: Arc<Sphere>, path: Arc<dyn Path>, weights: &Weights) -> Result<Self, PathError> {
        let point = path.at(weights)?;
        let image = sphere.render(point.as_ref());
        let mut scrub = Self { sphere, path, point, image, bytes: Vec::new() };
        scrub.image.display_bytes_into(1.0, &mut scrub.bytes);
        Ok(scrub)
    }

    /// Renders the frame at these weights, times `gain`. On an error the last frame stays.
    pub fn show(&mut self, weights: &Weights, gain: f32) -> Result<(), PathError> {
        self.path.move_to(weights, &mut self.point)?;
        self.sphere.render_into(self.point.as_ref(), &mut self.image);
        self.image.display_bytes_into(gain, &mut self.bytes);
        Ok(())
    }

    /// The material of the last frame.
    pub fn brdf(&self) -> &dyn Brdf {
        self.point.as_ref()
    }

    /// The last frame, linear.
    pub const fn image(&self) -> &Image {
        &self.image
    }

    /// The last frame as a display shows it: red, green, blue of each pixel.
    pub fn display_bytes(&self) -> &[u8] {
        &self.bytes
    }
}
