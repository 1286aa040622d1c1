//! A sphere for looking at: smooth edge, smooth highlights, on a ground of its own.

use nbrdf_core::render::{Light, Sphere};
use nbrdf_core::{Brdf, Image, Rgb};

/// Samples per pixel and direction of what the sphere shows, and of its outline.
const SHADED: usize = 2;
const OUTLINE: usize = 8;
/// Radius of the sphere in half image widths, as rendered.
const RADIUS: f32 = 0.99;

/// The geometry of one sphere, ready for any number of materials.
pub struct Cell {
    size: usize,
    sphere: Sphere,
    coverage: Vec<f32>,
}

impl Cell {
    /// `size` × `size` pixels under `light`.
    pub fn new(size: usize, light: &Light) -> Self {
        let coverage = (0..size * size).map(|i| coverage(size, i % size, i / size)).collect();
        Self { size, sphere: Sphere::new(size * SHADED, light), coverage }
    }

    /// The sphere on its ground, clipped to what a display shows; `gain` is the exposure.
    pub fn draw(&self, brdf: &dyn Brdf, gain: f32, ground: Rgb) -> Image {
        let fine = self.sphere.render(brdf);
        let pixel = |i: usize| {
            let inside = self.inside(&fine, i % self.size, i / self.size, gain).unwrap_or(ground);
            inside.zip(ground, |inside, ground| ground + (inside - ground) * self.coverage[i])
        };
        Image::new(self.size, self.size, (0..self.size * self.size).map(pixel).collect())
    }

    /// Mean of the samples on the sphere; clipped one by one, so that highlights have smooth edges.
    fn inside(&self, fine: &Image, x: usize, y: usize, gain: f32) -> Option<Rgb> {
        let samples = (0..SHADED * SHADED).map(|i| (x * SHADED + i % SHADED, y * SHADED + i / SHADED));
        let on_sphere = samples.filter(|(x, y)| self.sphere.covered()[y * fine.width() + x]);
        let (sum, count) = on_sphere.fold((Rgb::BLACK, 0.0), |(sum, count), (x, y)| {
            (sum + fine.get(x, y).map(|v| (v * gain).min(1.0)), count + 1.0)
        });
        (count > 0.0).then(|| sum * (1.0 / count))
    }
}

/// Share of a pixel that is on the sphere.
fn coverage(size: usize, x: usize, y: usize) -> f32 {
    let across =
        |pixel: usize, sub: usize| ((pixel * OUTLINE + sub) as f32 + 0.5) * 2.0 / (size * OUTLINE) as f32 - 1.0;
    let on = (0..OUTLINE * OUTLINE).filter(|i| across(x, i % OUTLINE).hypot(across(y, i / OUTLINE)) < RADIUS);
    on.count() as f32 / (OUTLINE * OUTLINE) as f32
}

#[cfg(test)]
mod tests {
    use nbrdf_core::brdf::lambert::Lambert;

    use super::*;

    #[test]
    fn corners_are_ground_the_middle_is_sphere_and_the_edge_is_between() {
        let cell = Cell::new(32, &Light::studio());
        let ground = Rgb::splat(0.01);
        let picture = cell.draw(&Lambert { albedo: Rgb::splat(0.8) }, 1.0, ground);
        assert_eq!(picture.get(0, 0), ground);
        assert!(picture.get(16, 16).min() > 0.2);
        let partly = cell.coverage.iter().filter(|&&share| share > 0.0 && share < 1.0).count();
        assert!((40..200).contains(&partly), "{partly}");
    }

    #[test]
    fn nothing_is_brighter_than_a_display() {
        let picture = Cell::new(16, &Light::studio()).draw(&Lambert { albedo: Rgb::splat(0.8) }, 100.0, Rgb::BLACK);
        assert!(picture.pixels().iter().all(|pixel| pixel.max() <= 1.0));
    }
}
