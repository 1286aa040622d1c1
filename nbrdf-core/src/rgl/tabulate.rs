//! Reflectances as `.bsdf` files, for Mitsuba's plugin `measured` and for every other reader of the RGL database.
//!
//! The parameterization of Dupuy & Jakob 2018, section 4: for each eye a density over half vectors, in (√θ, φ), says where a
//! table's places are, and a second one, over the table, where light is drawn. The paper takes the first from a material's
//! own distribution of normals, since it is measured before anything else is known. Here the reflectance is known: places
//! along θ of half vector and eye are as dense as the cube root of how much it bends there ([`Density`]), by how much light
//! that is; towards grazing eyes they crowd. The same places serve all eyes, so that highlights do not move between them.
//!
//! Values are f_r cos θ of the light with `jacobian` 0, and 0 below the horizon: lines drawn on into the negative would be
//! closer, and would leave samples of large negative weight. `ndf` / (4 `sigma`) is 1, for readers that apply it always.
//! Drawing in proportion to `luminance` gives f_r cos θ, but for a thousandth that is even.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use rayon::prelude::*;

use super::density::Density;
use super::write::{Numbers, Outgoing, bytes};
use super::{LARGEST, RglTable};
use crate::metric::LinearErrors;
use crate::render::Sphere;
use crate::{Brdf, Directions, Rgb};

/// The last eye \[rad\]: further down, none has any area.
const LAST_EYE: f64 = 89.9 * PI / 180.0;
/// Places at which bends along √θ of the half vector are looked at, with so many eyes and azimuths.
const HALVES: [usize; 3] = [257, 24, 16];
/// The same along θ of the eye, with so many half vectors and azimuths.
const EYES: [usize; 3] = [181, 48, 12];
/// Nowhere are places less dense than this share of the mean, for half vectors and eyes.
const FLOORS: [f64; 2] = [0.15, 0.3];
/// Share of the mean that is drawn everywhere.
const EVERYWHERE: f32 = 1e-3;

/// Sizes of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Polar angles of the eye.
    pub eyes: usize,
    /// Places along θ of the half vector, and as many along φ: Mitsuba wants a square.
    pub side: usize,
}

impl Resolution {
    /// From small to large: 0.9 to 57 MB.
    pub const LADDER: [Self; 5] = [
        Self { eyes: 24, side: 48 },
        Self { eyes: 32, side: 64 },
        Self { eyes: 48, side: 96 },
        Self { eyes: 64, side: 128 },
        Self { eyes: 96, side: 192 },
    ];
}

/// A reflectance that is to be tabulated, and where its places are.
pub struct Tabulation<'a> {
    brdf: &'a dyn Brdf,
    halves: Density,
    eyes: Density,
}

/// A table as a file.
#[derive(Clone, Debug)]
pub struct Tabulated {
    /// The file's bytes.
    pub file: Vec<u8>,
    /// Sizes of the table.
    pub resolution: Resolution,
    /// How far its spheres are: [`LinearErrors::of_pixels`], the worse of `point` and `studio`. Infinite where the file cannot be
    /// read again.
    pub error: f64,
}

/// The smallest table of [`Resolution::LADDER`] whose spheres under `point` and `studio` are within `tolerance` (in
/// [`LinearErrors::of_pixels`], the share of the light that is in another place) of those of the reflectance, as a file and
/// read again; the largest where none is, which [`Tabulated::error`] tells.
pub fn tabulated_within(brdf: &dyn Brdf, tolerance: f64, description: &str) -> Tabulated {
    let tabulation = Tabulation::new(brdf);
    let spheres = [Sphere::point(), Sphere::studio()];
    let pictures = spheres.map(|sphere| sphere.render(brdf));
    let error = |table: &RglTable| {
        let of = |(sphere, picture): (&&Sphere, _)| {
            LinearErrors::of(picture, &sphere.render(table), sphere.covered()).of_pixels
        };
        spheres.iter().zip(&pictures).map(of).fold(0.0, f64::max)
    };
    let of = |resolution| {
        let file = tabulation.to_bytes(resolution, description);
        let error = RglTable::parse(&file).map_or(f64::INFINITY, |table| error(&table));
        Tabulated { file, resolution, error }
    };
    let [smaller @ .., largest] = Resolution::LADDER;
    smaller.into_iter().map(of).find(|table| table.error <= tolerance).unwrap_or_else(|| of(largest))
}

/// A pair of directions in the coordinates of a table, the eye at φ = 0.
struct Place {
    at: Directions,
    /// Cosine between eye and half vector; below 0 it is never seen.
    cosine: f64,
}

impl Place {
    /// `along`: √(2 θ / π) of the half vector, 0..1; `phi` its azimuth.
    fn new(theta_eye: f64, along: f64, phi: f64) -> Self {
        let view = DVec3::new(theta_eye.sin(), 0.0, theta_eye.cos());
        let theta = along * along * FRAC_PI_2;
        let half = DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        let cosine = view.dot(half);
        Self { at: Directions::new((half * (2.0 * cosine) - view).as_vec3(), view.as_vec3()), cosine }
    }

    fn is_seen(&self) -> bool {
        self.cosine > 0.0 && self.at.is_above()
    }

    /// dω of the light for a step in (√θ, φ) of the half vector, both 0..1.
    fn jacobian(&self, along: f64) -> f64 {
        let theta = along * along * FRAC_PI_2;
        2.0 * PI * PI * along * theta.sin() * 4.0 * self.cosine.max(0.0)
    }
}

/// f_r cos θ of the light at these places; 0 where nothing is seen, and for what is no number.
fn values(brdf: &dyn Brdf, places: &[Place]) -> Vec<Rgb> {
    let at: Vec<Directions> = places.iter().filter(|place| place.is_seen()).map(|place| place.at).collect();
    let mut found = vec![Rgb::BLACK; at.len()];
    brdf.eval_into(&at, &mut found);
    let mut found = found.into_iter();
    let value = |place: &Place| {
        let seen = if place.is_seen() { found.next() } else { None };
        let cosine = place.at.light.z;
        seen.map_or(Rgb::BLACK, |f| f.map(|f| if f.is_finite() { (f * cosine).clamp(0.0, LARGEST) } else { 0.0 }))
    };
    places.iter().map(value).collect()
}

/// The middle of each of so many parts of 0..1.
fn middles(parts: usize) -> impl Iterator<Item = f64> + Clone {
    (0..parts).map(move |part| (part as f64 + 0.5) / parts as f64)
}

/// So many even places from 0 to 1.
fn even(places: usize) -> impl Iterator<Item = f64> + Clone {
    (0..places).map(move |place| place as f64 / (places - 1) as f64)
}

/// Sums over lines of |second differences| by how much light they are.
fn bends(lines: impl ParallelIterator<Item = (Vec<Place>, Vec<f64>)>, brdf: &dyn Brdf, places: usize) -> Vec<f64> {
    let bend = |(line, weights): (Vec<Place>, Vec<f64>)| {
        let values: Vec<f64> = values(brdf, &line).into_iter().map(|value| f64::from(value.mean())).collect();
        let mut bends = vec![0.0; values.len()];
        for (place, around) in values.windows(3).enumerate() {
            bends[place + 1] = weights[place + 1] * (around[0] - 2.0 * around[1] + around[2]).abs();
        }
        bends
    };
    // Collected, so that the order of the sum is that of the lines.
    let lines: Vec<Vec<f64>> = lines.map(bend).collect();
    (0..places).map(|place| lines.iter().map(|line| line[place]).sum()).collect()
}

/// How much light a place is: of the eyes that a sphere shows, and of the lights that a half vector stands for.
fn weight(place: &Place, theta_eye: f64, along: f64) -> f64 {
    if place.is_seen() { place.jacobian(along) * theta_eye.sin() * theta_eye.cos() } else { 0.0 }
}

impl<'a> Tabulation<'a> {
    /// Looks at where the reflectance bends, at some 200 000 pairs of directions.
    pub fn new(brdf: &'a dyn Brdf) -> Self {
        let [places, eyes, azimuths] = HALVES;
        let along_halves = (0..eyes * azimuths).into_par_iter().map(|line| {
            let theta = (line / azimuths) as f64 / (eyes - 1) as f64 * LAST_EYE;
            let phi = (line % azimuths) as f64 / (azimuths - 1) as f64 * PI;
            let line: Vec<Place> = even(places).map(|along| Place::new(theta, along, phi)).collect();
            let weights = line.iter().zip(even(places)).map(|(place, along)| weight(place, theta, along)).collect();
            (line, weights)
        });
        let halves = Density::of_bends(&bends(along_halves, brdf, places), FLOORS[0]);
        let [places, half_vectors, azimuths] = EYES;
        let along_eyes = (0..half_vectors * azimuths).into_par_iter().map(|line| {
            let along = middles(half_vectors).nth(line / azimuths).unwrap_or_default();
            let phi = (line % azimuths) as f64 / (azimuths - 1) as f64 * PI;
            let eyes = || even(places).map(|share| share * LAST_EYE);
            let line: Vec<Place> = eyes().map(|theta| Place::new(theta, along, phi)).collect();
            let weights = line.iter().zip(eyes()).map(|(place, theta)| weight(place, theta, along)).collect();
            (line, weights)
        });
        let eyes = Density::of_bends(&bends(along_eyes, brdf, places), FLOORS[1]);
        Self { brdf, halves, eyes }
    }

    /// A file of this resolution; `description` is what Mitsuba's log calls the material.
    pub fn to_bytes(&self, resolution: Resolution, description: &str) -> Vec<u8> {
        let Resolution { eyes, side } = resolution;
        let theta: Vec<f64> = even(eyes).map(|share| self.eyes.place(share).0 * LAST_EYE).collect();
        let slices: Vec<Slice> = theta.par_iter().map(|&theta| Slice::new(self, theta, side)).collect();
        let rgb: Vec<f32> = slices.iter().flat_map(|slice| slice.rgb.iter().flatten()).copied().collect();
        let luminance: Vec<f32> = slices.iter().flat_map(|slice| &slice.luminance).copied().collect();
        // Even along φ: two rows say so.
        let row: Vec<f32> = self.halves.values().iter().map(|&value| value as f32).collect();
        let visible: Vec<f32> = std::iter::repeat_n(&row, 2 * eyes).flatten().copied().collect();
        let theta: Vec<f32> = theta.into_iter().map(|theta| theta as f32).collect();
        let about = if description.is_empty() { "material" } else { description };
        let floats = |name, shape, numbers| Outgoing { name, shape, numbers: Numbers::Floats(numbers) };
        bytes(&[
            Outgoing { name: "description", shape: &[about.len()], numbers: Numbers::Bytes(about.as_bytes()) },
            Outgoing { name: "jacobian", shape: &[1], numbers: Numbers::Bytes(&[0]) },
            floats("phi_i", &[1], &[0.0]),
            floats("theta_i", &[eyes], &theta),
            floats("ndf", &[2, 2], &[4.0; 4]),
            floats("sigma", &[2, 2], &[1.0; 4]),
            floats("vndf", &[1, eyes, 2, row.len()], &visible),
            floats("luminance", &[1, eyes, side, side], &luminance),
            floats("rgb", &[1, eyes, 3, side, side], &rgb),
        ])
    }
}

/// What one eye sees: rows are φ, columns θ of the half vector.
struct Slice {
    rgb: [Vec<f32>; 3],
    luminance: Vec<f32>,
}

impl Slice {
    fn new(tabulation: &Tabulation<'_>, theta: f64, side: usize) -> Self {
        let columns: Vec<(f64, f64)> = even(side).map(|share| tabulation.halves.place(share)).collect();
        let row = |share: f64| {
            let phi = (2.0 * share - 1.0) * PI;
            columns.iter().map(move |&(along, _)| Place::new(theta, along, phi))
        };
        let places: Vec<Place> = even(side).flat_map(row).collect();
        let values = values(tabulation.brdf, &places);
        let drawn = |(place, value): (usize, &Rgb)| {
            let (along, density) = columns[place % side];
            value.mean() * (places[place].jacobian(along) / density) as f32
        };
        let mut luminance: Vec<f32> = values.iter().enumerate().map(drawn).collect();
        let mean = luminance.iter().sum::<f32>() / luminance.len() as f32;
        // What is black is drawn evenly.
        let least = if mean > 0.0 { EVERYWHERE * mean } else { 1.0 };
        luminance.iter_mut().for_each(|value| *value += least);
        Self { rgb: [0, 1, 2].map(|channel| values.iter().map(|value| value[channel]).collect()), luminance }
    }
}

#[cfg(test)]
mod tests;
