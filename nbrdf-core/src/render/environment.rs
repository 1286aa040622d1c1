//! Light from all around, far away: a latitude-longitude map of radiance, looked up and drawn from.
//!
//! Orientation, in view space (+x right, +y up, +z towards the viewer): the top row is +y, the centre column +z, the
//! column a quarter from the left +x, both ends −z. This is the map of OpenEXR (`ImfEnvmap.h`) and of Mitsuba's `envmap`:
//! the picture seen by someone who stands at the sphere and looks at the viewer. The middle of a mirror sphere shows
//! the middle of the map, mirrored.
//!
//! Radiance is constant over a pixel (nearest lookup), and so is the density of [`Environment::sample`]: no light falls
//! where nothing is drawn. Pixels are drawn in proportion to luminance times solid angle, by marginal and conditional
//! distributions (M. Pharr, W. Jakob, G. Humphreys, *Physically Based Rendering*, 4th ed. 2023, sections 2.4.2 and
//! 12.5.2); within a pixel all solid angles are alike, where the book's density follows sin θ.

mod error;
mod latlong;
mod softboxes;
mod table;

use std::{f64::consts::PI, path::Path, sync::Arc};

pub use error::{EnvironmentError, EnvironmentProblem};
use glam::{DMat3, DVec3, Vec3};

use self::{latlong::LatLong, table::Table};
use crate::{Image, Rgb};

/// A radiance for every direction; clones share the map.
#[derive(Clone, Debug)]
pub struct Environment {
    map: Arc<Map>,
    /// From the map's directions to view space.
    rotation: DMat3,
}

#[derive(Debug)]
struct Map {
    radiance: Image,
    shape: LatLong,
    table: Table,
    /// ∫ luminance dω, or 0 if all is dark.
    total: f64,
}

/// A direction, what arrives from it, and how often it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnvironmentSample {
    /// Unit vector away from the surface, in view space.
    pub direction: Vec3,
    /// Radiance from there.
    pub radiance: Rgb,
    /// Density \[1/sr\] of [`Environment::sample`] over the sphere.
    pub pdf: f64,
}

impl Environment {
    /// Names that [`by_name`](Self::by_name) knows.
    pub const NAMES: [&'static str; 1] = ["softboxes"];

    /// From a map of radiances, twice as wide as high.
    ///
    /// # Errors
    /// [`EnvironmentProblem`] for another shape, or for the first pixel that is not finite or negative.
    pub fn new(radiance: Image) -> Result<Self, EnvironmentProblem> {
        error::check(&radiance)?;
        Ok(Self::of(radiance))
    }

    /// From a map known to be one.
    fn of(radiance: Image) -> Self {
        let shape = LatLong { width: radiance.width(), height: radiance.height() };
        let mut total = 0.0;
        for y in 0..shape.height {
            let row: f64 = (0..shape.width).map(|x| radiance.get(x, y).luminance()).sum();
            total += row * shape.solid_angle(y);
        }
        // In the dark, every direction is as good as any other.
        let weight = |x, y| if total > 0.0 { radiance.get(x, y).luminance() } else { 1.0 };
        let table = Table::new(shape.width, shape.height, weight, |y| shape.solid_angle(y));
        Self { map: Arc::new(Map { radiance, shape, table, total }), rotation: DMat3::IDENTITY }
    }

    /// Reads a map from a Radiance (`.hdr`) or OpenEXR (`.exr`) file.
    ///
    /// # Errors
    /// [`EnvironmentError`], which names the file: not read ([`Image::read`]), or no map ([`new`](Self::new)).
    pub fn load(path: &Path) -> Result<Self, EnvironmentError> {
        let of = |problem| EnvironmentError::Map { file: path.display().to_string(), problem };
        Self::new(Image::read(path)?).map_err(of)
    }

    /// The built-in environment of this name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        (name == "softboxes").then(Self::softboxes)
    }

    /// The map turned about +y by `angle` \[rad\], finite; a light at +z goes towards +x. Replaces an earlier turn.
    #[must_use]
    pub fn rotated(self, angle: f64) -> Self {
        Self { rotation: DMat3::from_rotation_y(angle), ..self }
    }

    /// The map itself, unturned.
    pub fn map(&self) -> &Image {
        &self.map.radiance
    }

    /// What arrives from `direction`, a unit vector in view space.
    pub fn radiance(&self, direction: Vec3) -> Rgb {
        self.look(direction).radiance
    }

    /// Density \[1/sr\] with which [`sample`](Self::sample) draws `direction`, a unit vector in view space.
    pub fn pdf(&self, direction: Vec3) -> f64 {
        self.look(direction).pdf
    }

    /// Radiance and density of a given `direction`, a unit vector in view space.
    pub fn look(&self, direction: Vec3) -> EnvironmentSample {
        let (x, y) = self.map.shape.pixel(self.rotation.transpose() * direction.as_dvec3());
        self.through(x, y, direction)
    }

    /// Draws a direction from `u`, uniform in \[0, 1)²: bright pixels often, dark ones seldom, black ones never
    /// (unless all are).
    pub fn sample(&self, u: [f64; 2]) -> EnvironmentSample {
        let drawn = self.map.table.draw(u);
        let direction: DVec3 = self.rotation * self.map.shape.direction(drawn.x, drawn.y, drawn.within);
        self.through(drawn.x, drawn.y, direction.as_vec3())
    }

    fn through(&self, x: usize, y: usize, direction: Vec3) -> EnvironmentSample {
        let radiance = self.map.radiance.get(x, y);
        let lit = self.map.total > 0.0;
        let pdf = if lit { radiance.luminance() / self.map.total } else { 0.25 / PI };
        EnvironmentSample { direction, radiance, pdf }
    }
}

#[cfg(test)]
mod tests;
