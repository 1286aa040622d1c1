//! Pictures of a sphere as measurements: every lit pixel under one light is a direction.
//!
//! J. B. Nielsen et al. (2015), extension to images: an orthographic picture of a sphere under a distant light sees one
//! θ_diff, half the angle between light and viewer, and every θ_half and φ_diff that goes with it. Which lights are good
//! is decided by the expected error, since for whole pictures the condition number misleads (Z. Xu et al. 2016).

use faer::Mat;
use rayon::prelude::*;

use super::super::log_table;
use super::design::{Criterion, posterior};
use super::log_relative::LogRelative;
use crate::nbrdf::samples::Samples;
use crate::sampling::evaluate;
use crate::{Brdf, Directions, Vec3};

/// Pixels per side.
const SIZE: usize = 32;
/// Angles between light and viewer that are tried \[degrees\].
const LIGHTS: std::ops::Range<u32> = 1..35;
/// Degrees between them.
const STEP: u32 = 5;
/// η for pixels: ten times that for directions, for neighbouring pixels repeat each other. Of 1, 10, 100 and 1000 the one
/// with the least error on the validation materials.
const DAMPING: f64 = 10.0;

/// One picture.
struct Picture {
    degrees: u32,
    /// Lit pixels.
    at: Vec<Directions>,
    /// Components at the pixels \[pixels, components\].
    rows: Mat<f64>,
    /// The middle material at the pixels.
    base: Vec<f64>,
    gram: Mat<f64>,
}

/// All pictures that may be taken.
pub struct SphereImages<'a> {
    basis: &'a LogRelative,
    pictures: Vec<Picture>,
    criterion: Criterion,
}

impl<'a> SphereImages<'a> {
    /// Pictures under lights at 5° to 170° from the viewer.
    pub fn new(basis: &'a LogRelative) -> Self {
        let picture = |degrees: u32| {
            let (sin, cos) = (degrees as f32).to_radians().sin_cos();
            let at = Samples::sphere(SIZE, Vec3::new(sin, 0.0, cos)).at.directions().to_vec();
            let loadings: Vec<Vec<f64>> = at.iter().map(|&at| basis.loadings_at(at)).collect();
            let rows = Mat::from_fn(at.len(), basis.components(), |row, k| loadings[row][k]);
            let base = at.iter().map(|&at| basis.base_at(at)).collect();
            let gram = rows.transpose() * &rows;
            Picture { degrees, at, rows, base, gram }
        };
        let pictures = LIGHTS.into_par_iter().map(|light| picture(light * STEP)).collect();
        Self { basis, pictures, criterion: Criterion::expected_error(basis, DAMPING) }
    }

    /// The `count` pictures to take, best together: the best beside those before it, then exchanged one at a time.
    /// Angles between light and viewer \[degrees\], rising.
    pub fn choose(&self, count: usize) -> Vec<u32> {
        let all: Vec<usize> = (0..self.pictures.len()).collect();
        let mut chosen: Vec<usize> = Vec::new();
        let better = |others: &[usize]| {
            let cost = |&new: &usize| self.criterion.cost_of_gram(&self.gram(others.iter().chain([&new])));
            let free = all.iter().filter(|new| !others.contains(new));
            free.map(|new| (cost(new), *new)).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, new)| new)
        };
        while chosen.len() < count.min(all.len()) {
            chosen.extend(better(&chosen));
        }
        for _ in 0..count {
            let before = chosen.clone();
            for slot in 0..chosen.len() {
                let mut others = chosen.clone();
                others.remove(slot);
                chosen[slot] = better(&others).unwrap_or(chosen[slot]);
            }
            if chosen == before {
                break;
            }
        }
        chosen.sort_unstable();
        chosen.into_iter().map(|picture| self.pictures[picture].degrees).collect()
    }

    /// Lit pixels of the pictures under these lights \[degrees\].
    pub fn pixels(&self, lights: &[u32]) -> usize {
        let taken = self.pictures.iter().filter(|picture| lights.contains(&picture.degrees));
        taken.map(|picture| picture.at.len()).sum()
    }

    /// The coefficients of the material behind pictures under these lights \[degrees\]; none where it is not finite.
    pub fn coefficients(&self, material: &dyn Brdf, lights: &[u32]) -> Option<[Vec<f32>; 3]> {
        let taken: Vec<usize> =
            (0..self.pictures.len()).filter(|&picture| lights.contains(&self.pictures[picture].degrees)).collect();
        let uncertain = posterior(&self.gram(taken.iter()), DAMPING)?;
        let k = self.basis.components();
        let mut slopes = Mat::zeros(k, 3);
        for picture in taken.iter().map(|&picture| &self.pictures[picture]) {
            let seen = picture.at.iter().zip(evaluate(material, &picture.at)).map(|(&at, f)| log_table::stored(at, f));
            let seen: Vec<_> = seen.collect();
            let rest = Mat::from_fn(seen.len(), 3, |row, channel| f64::from(seen[row][channel]) - picture.base[row]);
            slopes += picture.rows.transpose() * rest;
        }
        let solved = uncertain * slopes;
        let coefficients = [0, 1, 2].map(|channel| (0..k).map(|i| solved[(i, channel)] as f32).collect::<Vec<f32>>());
        coefficients.iter().flatten().all(|v| v.is_finite()).then_some(coefficients)
    }

    fn gram<'b>(&self, pictures: impl Iterator<Item = &'b usize>) -> Mat<f64> {
        let k = self.basis.components();
        pictures.fold(Mat::zeros(k, k), |sum, &picture| sum + &self.pictures[picture].gram)
    }
}
