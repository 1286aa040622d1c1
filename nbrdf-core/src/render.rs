//! A sphere of a material under directional lights.
//!
//! Orthographic view along +z, y up, the sphere's radius 0.99 of half the image; L = Σ f_r E cos θ_i over the lamps,
//! no interreflection, no shadow. The shading frame follows the globe: tangent to the east (y × n), bitangent
//! north. Isotropic materials do not see it; brushed ones show their grooves along the latitudes.
//!
//! Under an [`Environment`] the same sphere is a [`Progressive`] picture.

pub mod environment;
mod light;
mod progressive;
mod sequence;

use std::sync::OnceLock;

pub use environment::Environment;
use glam::{DMat3, DVec3};
pub use light::{Lamp, Light};
pub use progressive::Progressive;
use rayon::prelude::*;

use crate::{Brdf, Directions, Image, Rgb};

/// Pixels per side of the sphere in all metrics.
pub const METRIC_SIZE: usize = 128;
/// Radius of the sphere in half image widths.
const RADIUS: f64 = 0.99;
/// Up to this size the geometry is kept (28 MB at eleven lamps); beyond, each render derives it again row by row.
const KEPT_SIZE: usize = 256;

/// The geometry of one picture, ready for any number of materials.
#[derive(Clone, Debug)]
pub struct Sphere {
    size: usize,
    light: Light,
    covered: Vec<bool>,
    rows: Vec<Row>,
}

/// What one row of pixels asks of a material.
#[derive(Clone, Debug, Default)]
struct Row {
    /// Column of each covered pixel, and how many entries of `at` belong to it.
    pixels: Vec<(usize, usize)>,
    /// Lit pairs, in the frame of their pixel.
    at: Vec<Directions>,
    /// E cos θ_i of each pair.
    weights: Vec<Rgb>,
}

impl Sphere {
    /// A picture of `size` × `size` pixels under `light`.
    pub fn new(size: usize, light: &Light) -> Self {
        let covered = (0..size * size).map(|i| normal(size, i % size, i / size).is_some()).collect();
        let rows = if size <= KEPT_SIZE { (0..size).map(|y| Row::new(size, y, light)).collect() } else { Vec::new() };
        Self { size, light: light.clone(), covered, rows }
    }

    /// At the size of the metrics under light `point`; made once.
    pub fn point() -> &'static Self {
        static SPHERE: OnceLock<Sphere> = OnceLock::new();
        SPHERE.get_or_init(|| Self::new(METRIC_SIZE, &Light::point()))
    }

    /// At the size of the metrics under light `studio`; made once.
    pub fn studio() -> &'static Self {
        static SPHERE: OnceLock<Sphere> = OnceLock::new();
        SPHERE.get_or_init(|| Self::new(METRIC_SIZE, &Light::studio()))
    }

    /// Pixels per side.
    pub const fn size(&self) -> usize {
        self.size
    }

    /// The light it stands in.
    pub const fn light(&self) -> &Light {
        &self.light
    }

    /// For each pixel, row by row from the top left, whether its centre is on the sphere.
    pub fn covered(&self) -> &[bool] {
        &self.covered
    }

    /// The linear picture, black off the sphere; exposure is left to whoever shows it.
    ///
    /// Rows are shaded in parallel; the result does not depend on the number of threads.
    pub fn render(&self, brdf: &dyn Brdf) -> Image {
        let mut pixels = vec![Rgb::BLACK; self.size * self.size];
        pixels.par_chunks_mut(self.size.max(1)).enumerate().for_each(|(y, out)| match self.rows.get(y) {
            Some(row) => row.shade(brdf, out),
            None => Row::new(self.size, y, &self.light).shade(brdf, out),
        });
        Image::new(self.size, self.size, pixels)
    }
}

impl Row {
    fn new(size: usize, y: usize, light: &Light) -> Self {
        let mut row = Self::default();
        for x in 0..size {
            if let Some(normal) = normal(size, x, y) {
                let before = row.at.len();
                row.light_up(normal, light);
                row.pixels.push((x, row.at.len() - before));
            }
        }
        row
    }

    /// Adds the pairs of one pixel: one for each lamp in front of its surface.
    fn light_up(&mut self, normal: DVec3, light: &Light) {
        let to_surface = frame(normal).transpose();
        let local = |v: DVec3| to_surface * v;
        let view = local(DVec3::Z).as_vec3();
        for lamp in &light.lamps {
            let direction = local(lamp.direction.as_dvec3());
            let at = Directions::new(direction.as_vec3(), view);
            if at.is_above() {
                self.at.push(at);
                self.weights.push(lamp.irradiance * at.light.z);
            }
        }
    }

    fn shade(&self, brdf: &dyn Brdf, out: &mut [Rgb]) {
        let mut values = vec![Rgb::BLACK; self.at.len()];
        brdf.eval_into(&self.at, &mut values);
        let mut terms = values.iter().zip(&self.weights);
        for &(x, lamps) in &self.pixels {
            let mut radiance = [0.0_f64; 3];
            for (value, weight) in terms.by_ref().take(lamps) {
                for (channel, sum) in radiance.iter_mut().enumerate() {
                    *sum += f64::from(value[channel]) * f64::from(weight[channel]);
                }
            }
            out[x] = Rgb(radiance.map(|sum| sum as f32));
        }
    }
}

/// The sphere's normal at the centre of a pixel, if it is on the sphere.
fn normal(size: usize, x: usize, y: usize) -> Option<DVec3> {
    let across = |pixel: usize| ((2 * pixel + 1) as f64 / size as f64 - 1.0) / RADIUS;
    let (x, y) = (across(x), -across(y));
    let z2 = 1.0 - x * x - y * y;
    (z2 > 0.0).then(|| DVec3::new(x, y, z2.sqrt()))
}

/// The shading frame as columns: east, north, out. From the surface to view space; its transpose leads back.
fn frame(normal: DVec3) -> DMat3 {
    let tangent = DVec3::Y.cross(normal).normalize();
    DMat3::from_cols(tangent, normal.cross(tangent), normal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Vec3,
        brdf::{ggx::Ggx, lambert::Lambert},
    };

    const WHITE: Lambert = Lambert { albedo: Rgb::splat(1.0) };
    const GLOSSY: Ggx = Ggx { diffuse: Rgb([0.2, 0.1, 0.0]), f0: Rgb::splat(0.04), alpha: 0.2 };

    #[test]
    fn white_facing_the_point_light_shows_one() {
        let image = Sphere::point().render(&WHITE);
        let brightest = image.pixels().iter().map(|pixel| pixel[1]).fold(0.0, f32::max);
        assert!((brightest - 1.0).abs() < 2e-4, "{brightest}");
    }

    #[test]
    fn lambert_shows_the_cosine_of_light_and_normal() {
        let sphere = Sphere::new(9, &Light::directional(Vec3::new(0.0, 2.0, 0.0)));
        let image = sphere.render(&WHITE);
        assert!((image.get(4, 2)[0] - (4.0 / 9.0) / 0.99).abs() < 1e-6, "two pixels above the centre");
        assert_eq!(image.get(4, 6), Rgb::BLACK, "the lower half is in the dark");
    }

    #[test]
    fn the_disc_covers_its_share_of_the_image() {
        let share = Sphere::point().covered().iter().filter(|&&on| on).count() as f64 / (128.0 * 128.0);
        assert!((share - std::f64::consts::PI / 4.0 * RADIUS * RADIUS).abs() < 2e-3);
    }

    #[test]
    fn light_from_the_left_mirrors_light_from_the_right() {
        let from = |x: f32| Sphere::new(32, &Light::directional(Vec3::new(x, 0.3, 0.5))).render(&GLOSSY);
        let (left, right) = (from(-0.7), from(0.7));
        for y in 0..32 {
            for x in 0..32 {
                assert!((left.get(x, y)[0] - right.get(31 - x, y)[0]).abs() < 1e-4);
            }
        }
    }

    #[test]
    fn the_number_of_threads_does_not_change_a_bit() {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Sphere::studio().render(&GLOSSY))
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn large_pictures_do_not_keep_their_geometry_and_are_no_different() {
        let kept = Sphere::new(KEPT_SIZE, &Light::studio());
        let derived = Sphere { rows: Vec::new(), ..kept.clone() };
        assert!(Sphere::new(KEPT_SIZE + 1, &Light::studio()).rows.is_empty());
        assert_eq!(kept.render(&GLOSSY), derived.render(&GLOSSY));
    }
}
