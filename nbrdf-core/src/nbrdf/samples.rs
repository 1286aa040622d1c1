//! Random directions and sphere pixels on which a fit compares two reflectances.

use rand::{Rng, RngExt};

use crate::brdf::Prepared;
use crate::direction::{spherical, turned};
use crate::sampling::half_difference;
use crate::{Brdf, Directions, Rgb, Vec3};

/// How directions are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Angular {
    /// Uniform in θ_half, θ_diff, φ_diff: the adaptive angular sampling of Sztrajman et al. (2021), section 3.2. Half
    /// vectors near the normal, where highlights are, get far more than their share of the solid angle.
    HalfDifference,
    /// Light and view uniform over the hemisphere: for comparison.
    SolidAngle,
}

/// How many samples of each kind.
#[derive(Clone, Copy, Debug)]
pub struct SampleCounts {
    /// Directions compared as ln(1 + f cos θ_i).
    pub log: usize,
    /// Directions compared as ln(f cos θ_i + 10⁻³).
    pub relative: usize,
    /// Pixels of a sphere, compared as displayed.
    pub pixels: usize,
    /// Lights on every pixel.
    pub lamps: usize,
}

impl SampleCounts {
    /// One step of a fit or of training.
    pub const STEP: Self = Self { log: 128, relative: 256, pixels: 32, lamps: 4 };
    /// A whole refinement, which keeps its samples from step to step.
    pub const REFINE: Self = Self { log: 2048, relative: 2048, pixels: 768, lamps: 4 };

    const fn directions(self) -> usize {
        self.log + self.relative + self.lamps * self.pixels
    }
}

/// Directions in the order log, relative, pixels.
#[derive(Clone, Debug)]
pub struct Samples {
    /// How many of each kind.
    pub counts: SampleCounts,
    /// Light and view of every sample.
    pub at: Prepared,
    /// cos θ_i; for a pixel's lamp also times its irradiance.
    pub factors: Vec<f32>,
}

impl Samples {
    /// Draws directions uniformly in (θ_half, θ_diff, φ_diff), and pixels uniformly over a sphere's disc.
    pub fn random(rng: &mut impl Rng, counts: SampleCounts) -> Self {
        Self::drawn(rng, counts, Angular::HalfDifference)
    }

    /// As [`random`](Self::random), with directions drawn either way.
    pub fn drawn(rng: &mut impl Rng, counts: SampleCounts, angular: Angular) -> Self {
        let mut directions = Vec::with_capacity(counts.directions());
        let mut factors = Vec::with_capacity(counts.directions());
        while directions.len() < counts.log + counts.relative {
            let at = match angular {
                Angular::HalfDifference => random_directions(rng),
                Angular::SolidAngle => Directions::new(random_upward(rng), random_upward(rng)),
            };
            if at.is_above() {
                directions.push(at);
                factors.push(at.light.z);
            }
        }
        for _ in 0..counts.pixels {
            let view = on_sphere(rng.random_range(0.0..0.98));
            for _ in 0..counts.lamps {
                let light = random_light(rng, view);
                directions.push(Directions::new(light, view));
                factors.push(light.z * irradiance(rng.random_range(0.0..1.0)));
            }
        }
        Self::new(counts, directions, factors)
    }

    /// The lit pixels of a sphere under one directional light, as the published autoencoder was trained on:
    /// `size`² pixels seen along +z, `light` towards the light in the viewer's frame, irradiance π.
    pub fn sphere(size: usize, light: Vec3) -> Self {
        let (mut directions, mut factors) = (Vec::new(), Vec::new());
        let centre = |i: usize| ((i as f32 + 0.5) / size as f32 * 2.0 - 1.0) / 0.99;
        for (row, column) in (0..size * size).map(|pixel| (pixel / size, pixel % size)) {
            let (x, y) = (centre(column), -centre(row));
            let r2 = x * x + y * y;
            if r2 >= 1.0 {
                continue;
            }
            let normal = Vec3::new(x, y, (1.0 - r2).sqrt());
            let (tangent, bitangent) = normal.any_orthonormal_pair();
            let local = |v: Vec3| Vec3::new(v.dot(tangent), v.dot(bitangent), v.dot(normal));
            let at = Directions::new(local(light), local(Vec3::Z));
            if at.is_above() {
                directions.push(at);
                factors.push(at.light.z * std::f32::consts::PI);
            }
        }
        let counts = SampleCounts { log: 0, relative: 0, pixels: directions.len(), lamps: 1 };
        Self::new(counts, directions, factors)
    }

    /// From given directions, in the order log, relative, pixels, and their factors.
    ///
    /// # Panics
    /// If there are not as many as `counts` says (a bug of the caller).
    pub fn new(counts: SampleCounts, directions: Vec<Directions>, factors: Vec<f32>) -> Self {
        assert!([directions.len(), factors.len()] == [counts.directions(); 2], "as many samples as counted");
        Self { counts, at: Prepared::new(directions), factors }
    }

    /// The same about the normal, each by an angle of its own and the lamps of a pixel together: for materials that change
    /// when they are turned.
    pub fn turned(self, rng: &mut impl Rng) -> Self {
        let Self { counts, at, factors } = self;
        let (single, pixels) = at.directions().split_at(counts.log + counts.relative);
        let mut directions = Vec::with_capacity(at.len());
        for together in single.chunks(1).chain(pixels.chunks(counts.lamps.max(1))) {
            let angle = rng.random_range(0.0..std::f32::consts::TAU);
            directions.extend(together.iter().map(|&at| turned(at, angle)));
        }
        Self { counts, at: Prepared::keeping_azimuth(directions), factors }
    }

    /// The same, read with the azimuth.
    pub fn keeping_azimuth(self) -> Self {
        Self { at: Prepared::keeping_azimuth(self.at.directions().to_vec()), ..self }
    }

    /// The reflectance at every sample.
    pub fn values(&self, brdf: &dyn Brdf) -> Vec<Rgb> {
        let mut values = vec![Rgb::BLACK; self.at.len()];
        brdf.eval_prepared(&self.at, &mut values);
        values
    }
}

/// A pair uniform in θ_half, θ_diff, φ_diff; it may lie below the horizon.
pub(crate) fn random_directions(rng: &mut impl Rng) -> Directions {
    half_difference([(); 3].map(|()| rng.random_range(0.0..1.0)))
}

/// The view of a pixel of an orthographic sphere: sin² θ_o is uniform over the disc.
fn on_sphere(sin2: f32) -> Vec3 {
    Vec3::new(sin2.sqrt(), 0.0, (1.0 - sin2).sqrt())
}

/// Of a lamp, mostly dim.
fn irradiance(share: f32) -> f32 {
    std::f32::consts::PI * (0.03 + 0.8 * share * share)
}

/// A direction uniform over the hemisphere.
fn random_upward(rng: &mut impl Rng) -> Vec3 {
    let cos: f32 = rng.random_range(0.0..1.0);
    spherical(cos.acos(), rng.random_range(0.0..std::f32::consts::TAU))
}

/// A light above the surface and not behind the sphere.
fn random_light(rng: &mut impl Rng, view: Vec3) -> Vec3 {
    loop {
        if let Some(light) = light_at(view, [(); 2].map(|()| rng.random_range(0.0..1.0))) {
            return light;
        }
    }
}

/// The light at these shares of the hemisphere, unless it is behind the sphere.
fn light_at(view: Vec3, [cos, around]: [f32; 2]) -> Option<Vec3> {
    let light = spherical((0.01 + 0.99 * cos).acos(), std::f32::consts::TAU * around);
    (light.dot(view) > -0.2).then_some(light)
}
