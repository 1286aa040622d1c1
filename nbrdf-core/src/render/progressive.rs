//! A sphere under an environment, better with every pass.
//!
//! The geometry is that of [`Sphere`](super::Sphere): any [`Surfaces`], pixel centres, the same shading frames; what a
//! mesh hides from itself is dark. Each pass estimates ∫ f_r L cos θ_i dω in every pixel from two lights, one drawn by the material's
//! [`Sampler`], one by the environment, with the balance heuristic (E. Veach, L. Guibas, *Optimally Combining Sampling
//! Techniques for Monte Carlo Rendering*, 1995, section 3.3): either light counts f_r L cos θ_i / (p_material +
//! p_environment), and the estimate is their sum. It is unbiased for any sampler; a good one only needs fewer passes.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::{Environment, Surface, Surfaces, environment::EnvironmentSample, sequence::Point};
use crate::{Brdf, Directions, Image, Rgb, Sampler};

/// What a [`Point`] is for.
const MATERIAL: u64 = 0;
const ENVIRONMENT: u64 = 1;

/// A picture that grows; change the material only together with [`restart`](Self::restart).
#[derive(Clone, Debug)]
pub struct Progressive {
    surfaces: Arc<Surfaces>,
    environment: Environment,
    seed: u64,
    /// Sum of the estimates of each pixel, row by row from the top left.
    sums: Vec<[f64; 3]>,
    passes: u32,
}

impl Progressive {
    /// A sphere in `size` × `size` pixels, still black. Same seed, material and sampler, same bits.
    pub fn new(size: usize, environment: Environment, seed: u64) -> Self {
        Self::of(Arc::new(Surfaces::sphere(size)), environment, seed)
    }

    /// The same of any surface.
    pub fn of(surfaces: Arc<Surfaces>, environment: Environment, seed: u64) -> Self {
        let sums = vec![[0.0; 3]; surfaces.size() * surfaces.size()];
        Self { surfaces, environment, seed, sums, passes: 0 }
    }

    /// Adds one estimate to each pixel. Rows go in parallel; the result does not depend on the number of threads.
    pub fn pass(&mut self, brdf: &dyn Brdf, sampler: &dyn Sampler) {
        let (surfaces, passes) = (self.surfaces.as_ref(), self.passes);
        let pass = Pass { surfaces, passes, seed: self.seed, environment: &self.environment, brdf, sampler };
        let rows = self.sums.par_chunks_mut(surfaces.size().max(1)).enumerate();
        rows.for_each_init(Batch::default, |batch, (y, sums)| pass.row(y, sums, batch));
        self.passes += 1;
    }

    /// How many estimates each pixel holds.
    pub const fn passes(&self) -> u32 {
        self.passes
    }

    /// Pixels per side.
    pub fn size(&self) -> usize {
        self.surfaces.size()
    }

    /// The linear mean of all passes so far, black beside the surface and before the first pass.
    pub fn image(&self) -> Image {
        let share = 1.0 / f64::from(self.passes.max(1));
        let mean = |sum: &[f64; 3]| Rgb(sum.map(|sum| (sum * share).min(f64::from(f32::MAX)) as f32));
        Image::new(self.size(), self.size(), self.sums.iter().map(mean).collect())
    }

    /// Black again, as if no pass had been.
    pub fn restart(&mut self) {
        self.sums.fill([0.0; 3]);
        self.passes = 0;
    }
}

/// What all rows of one pass share.
struct Pass<'a> {
    surfaces: &'a Surfaces,
    passes: u32,
    seed: u64,
    environment: &'a Environment,
    brdf: &'a dyn Brdf,
    sampler: &'a dyn Sampler,
}

/// What one row asks of the material, kept from row to row.
#[derive(Default)]
struct Batch {
    at: Vec<Directions>,
    /// The pixel's column, and L cos θ_i / (p_material + p_environment), of each pair.
    terms: Vec<(usize, [f64; 3])>,
    values: Vec<Rgb>,
}

impl Pass<'_> {
    fn row(&self, y: usize, sums: &mut [[f64; 3]], batch: &mut Batch) {
        batch.at.clear();
        batch.terms.clear();
        for x in 0..self.surfaces.size() {
            if let Some(surface) = self.surfaces.at(x, y) {
                self.draw(x, y, &surface, batch);
            }
        }
        batch.values.resize(batch.at.len(), Rgb::BLACK);
        self.brdf.eval_into(&batch.at, &mut batch.values);
        for (&(x, weight), value) in batch.terms.iter().zip(&batch.values) {
            for (channel, sum) in sums[x].iter_mut().enumerate() {
                *sum += f64::from(value[channel]) * weight[channel];
            }
        }
    }

    /// Two lights for one pixel.
    fn draw(&self, x: usize, y: usize, surface: &Surface, batch: &mut Batch) {
        let pixel = (y * self.surfaces.size() + x) as u64;
        let point = |purpose| Point::new(self.seed, pixel, purpose, self.passes.into());
        let to_view = surface.to_view();
        let to_surface = to_view.transpose();
        let view = (to_surface * surface.view).as_vec3();
        let is_open = |direction: DVec3| self.surfaces.is_open(surface, direction);

        let own = self.sampler.sample(view, point(MATERIAL).f32());
        let towards = to_view * own.light.as_dvec3();
        let seen = self.environment.look(towards.as_vec3());
        batch.push(x, Directions::new(own.light, view), seen, own.pdf, || is_open(towards));

        let seen = self.environment.sample(point(ENVIRONMENT).f64());
        let towards = seen.direction.as_dvec3();
        let at = Directions::new((to_surface * towards).as_vec3(), view);
        batch.push(x, at, seen, self.sampler.pdf(at), || is_open(towards));
    }
}

impl Batch {
    fn push(
        &mut self,
        x: usize,
        at: Directions,
        seen: EnvironmentSample,
        own_pdf: f32,
        is_open: impl FnOnce() -> bool,
    ) {
        let scale = f64::from(at.light.z) / (f64::from(own_pdf) + seen.pdf);
        // Lights below the horizon and black ones add nothing; the model need not be asked.
        if at.is_above() && scale.is_finite() && seen.radiance.max() > 0.0 && is_open() {
            self.at.push(at);
            self.terms.push((x, seen.radiance.0.map(|radiance| f64::from(radiance) * scale)));
        }
    }
}

#[cfg(test)]
mod tests;
