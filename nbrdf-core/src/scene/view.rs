//! One pass over everything that is seen: who is in which pixel, lit from where.
//!
//! Every ray meets every light once: a direction drawn from the light, and one drawn from the material for all lights
//! together, weighted by the balance heuristic (E. Veach, L. Guibas, *Optimally Combining Sampling Techniques for Monte
//! Carlo Rendering*, 1995, section 3.3). The directions are those of the *reference* materials and are kept, so that other
//! models of a material are compared in the same pixels under the same light, noise included.

use std::cmp::Reverse;

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::lamp::Arriving;
use super::{Demand, Hit, Object, Picture, Ray, Scene};
use crate::render::sequence::Point;
use crate::sampler::Sampler;
use crate::sampler::lobe::Lobe;
use crate::{Directions, Image, Rgb};

/// What a [`Point`] is for; lights follow.
const CAMERA: u64 = 0;
const MATERIAL: u64 = 1;
const LIGHTS: u64 = 2;
/// Shadow rays end a little before the light.
const BEFORE: f64 = 1.0 - 1e-6;

/// What a picture of a scene asks for; made once, for any number of models.
#[derive(Clone, Debug)]
pub struct View {
    picture: Picture,
    /// Lights and environment where they are seen.
    background: Image,
    demands: Vec<Demand>,
    /// The object that most rays of a pixel meet.
    owners: Vec<Option<usize>>,
}

/// How a view is gathered: seed of the rays, who is told of every row, who may stop it.
#[derive(Clone, Copy)]
pub struct Gathering<'a> {
    /// Same seed, same bits.
    pub seed: u64,
    /// Called after every row.
    pub done: &'a (dyn Fn() + Sync),
    /// Asked before every row.
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
}

impl View {
    /// Follows the rays; `lobes` draw lights for the objects' materials, one each. None when cancelled.
    ///
    /// # Panics
    /// If there is not one lobe per object (a bug of the caller).
    pub fn gather(scene: &Scene, lobes: &[Lobe], how: Gathering) -> Option<Self> {
        assert_eq!(lobes.len(), scene.objects.len(), "one lobe per object");
        let Picture { width, height, .. } = scene.picture;
        let strides = strides(scene.picture.samples, LIGHTS as usize + scene.lamps.len());
        let pass = Pass { scene, lobes, seed: how.seed, strides };
        let row = |y: usize| {
            if (how.cancelled)() {
                return None;
            }
            let row = pass.row(y);
            (how.done)();
            Some(row)
        };
        let rows: Vec<Row> = (0..height).into_par_iter().map(row).collect::<Option<_>>()?;
        let mut demands = vec![Demand::default(); scene.objects.len()];
        let (mut background, mut owners) = (Vec::with_capacity(width * height), Vec::with_capacity(width * height));
        for (y, row) in rows.into_iter().enumerate() {
            let mut from = 0;
            for (object, x, end) in row.rays {
                demands[object].push(y * width + x, &row.at[from..end], &row.weights[from..end]);
                from = end;
            }
            background.extend(row.background);
            owners.extend(row.owners);
        }
        Some(Self { picture: scene.picture, background: Image::new(width, height, background), demands, owners })
    }

    /// Size and exposure.
    pub const fn picture(&self) -> &Picture {
        &self.picture
    }

    /// What every object's material is asked for.
    pub fn demands(&self) -> &[Demand] {
        &self.demands
    }

    /// The pixels that show an object more than anything else, or where it is too small for that, all that show it.
    pub fn pixels_of(&self, object: usize) -> Vec<usize> {
        let owned: Vec<usize> =
            self.demands[object].pixels().filter(|&pixel| self.owners[pixel] == Some(object)).collect();
        if owned.is_empty() { self.demands[object].pixels().collect() } else { owned }
    }

    /// Objects that no ray has met.
    pub fn unseen<'a>(&'a self, objects: &'a [Object]) -> impl Iterator<Item = &'a Object> {
        self.demands.iter().zip(objects).filter(|(demand, _)| demand.pixels().len() == 0).map(|(_, object)| object)
    }

    /// The linear picture with these radiances of the objects, as [`Demand::radiance`] gives them.
    pub fn image<'a>(&self, radiances: impl IntoIterator<Item = &'a Vec<Rgb>>) -> Image {
        let mut image = self.background.clone();
        for (demand, radiance) in self.demands.iter().zip(radiances) {
            for (pixel, own) in demand.pixels().zip(radiance) {
                image.pixels_mut()[pixel] += *own;
            }
        }
        image
    }
}

struct Pass<'a> {
    scene: &'a Scene,
    lobes: &'a [Lobe],
    seed: u64,
    /// See [`strides`].
    strides: Vec<usize>,
}

/// What one row of pixels asks for.
#[derive(Default)]
struct Row {
    /// Object, column, and the end of its pairs, ray by ray.
    rays: Vec<(usize, usize, usize)>,
    at: Vec<Directions>,
    weights: Vec<Rgb>,
    background: Vec<Rgb>,
    owners: Vec<Option<usize>>,
}

impl Pass<'_> {
    fn row(&self, y: usize) -> Row {
        let Picture { width, samples, .. } = self.scene.picture;
        let share = 1.0 / samples as f64;
        let mut row = Row::default();
        let mut counts = vec![0; self.scene.objects.len()];
        for x in 0..width {
            let first = row.rays.len();
            let mut background = DVec3::ZERO;
            for index in 0..samples {
                let point = |purpose: u64| {
                    let pass = index * self.strides[purpose as usize] % samples;
                    Point::new(self.seed, (y * width + x) as u64, purpose, pass as u64)
                };
                let [u, v] = point(CAMERA).f64();
                let ray = self.scene.camera.ray(&self.scene.picture, x as f64 + u, y as f64 + v);
                let hit = self.scene.hit(&ray);
                let distance = hit.as_ref().map_or(f64::INFINITY, |(_, hit)| hit.distance);
                if let Some(seen) = self.seen(&ray, distance) {
                    background += seen * share;
                } else if let Some((object, hit)) = hit {
                    self.light_up(&ray, &hit, object, &point, &mut row);
                    row.rays.push((object, x, row.at.len()));
                }
            }
            row.background.push(Rgb(background.as_vec3().to_array()));
            row.owners.push(owner(&row.rays[first..], samples, &mut counts));
        }
        row.weights.iter_mut().for_each(|weight| *weight = *weight * share as f32);
        row
    }

    /// A light that the camera sees before it sees anything else.
    fn seen(&self, ray: &Ray, limit: f64) -> Option<DVec3> {
        let lights = self.scene.lamps.iter().filter(|lamp| lamp.is_seen());
        let met = lights.filter_map(|lamp| lamp.look(ray.origin, ray.direction));
        // The environment is infinitely far away, as is nothing at all.
        let met = met.filter(|met| met.distance < limit || limit == f64::INFINITY);
        met.min_by(|a, b| a.distance.total_cmp(&b.distance)).map(|met| met.radiance)
    }

    /// Adds the pairs of one place.
    fn light_up(&self, ray: &Ray, hit: &Hit, object: usize, point: &dyn Fn(u64) -> Point, row: &mut Row) {
        let place = ray.at(hit.distance);
        let (tangent, bitangent) = hit.normal.any_orthonormal_pair();
        let to_world = DMat3::from_cols(tangent, bitangent, hit.normal);
        let to_surface = to_world.transpose();
        let view = (to_surface * -ray.direction).as_vec3();
        let lobe = &self.lobes[object];
        let is_clear = |arriving: &Arriving| {
            hit.geometric.dot(arriving.direction) > 0.0
                && self.scene.is_clear(&ray.leaving(hit, arriving.direction), arriving.distance * BEFORE)
        };
        let mut add = |at: Directions, radiance: DVec3| {
            let weight = Rgb((radiance * f64::from(at.light.z)).as_vec3().to_array());
            if at.is_above() && weight.max() > 0.0 && weight.is_finite() {
                row.at.push(at);
                row.weights.push(weight);
            }
        };
        for (index, lamp) in self.scene.lamps.iter().enumerate() {
            let Some(arriving) = lamp.draw(place, point(LIGHTS + index as u64).f64()) else { continue };
            let at = Directions::new((to_surface * arriving.direction).as_vec3(), view);
            if !at.is_above() || !is_clear(&arriving) {
                continue;
            }
            let density = arriving.pdf.map_or(1.0, |pdf| pdf + f64::from(lobe.pdf(at)));
            add(at, arriving.radiance / density);
        }
        let drawn = lobe.sample(view, point(MATERIAL).f32());
        let direction = (to_world * drawn.light.as_dvec3()).normalize();
        let met = self.scene.lamps.iter().filter_map(|lamp| lamp.look(place, direction)).filter(|met| {
            // Dark corners of a map need no shadow ray.
            met.radiance != DVec3::ZERO && is_clear(met)
        });
        let radiance = met.map(|met| met.radiance / (met.pdf.unwrap_or(0.0) + f64::from(drawn.pdf))).sum();
        add(Directions::new(drawn.light, view), radiance);
    }
}

/// The object that more of a pixel's rays meet than any other, and not fewer than meet none.
fn owner(rays: &[(usize, usize, usize)], samples: usize, counts: &mut [usize]) -> Option<usize> {
    rays.iter().for_each(|ray| counts[ray.0] += 1);
    let most = rays.iter().map(|ray| (counts[ray.0], Reverse(ray.0))).max();
    rays.iter().for_each(|ray| counts[ray.0] = 0);
    let (count, Reverse(object)) = most?;
    (count >= samples - rays.len()).then_some(object)
}

/// Steps through a pixel's points, one for every purpose, each coprime to their number: all are used, in another order for
/// every purpose, so that a place in the pixel does not go with a place on a light.
fn strides(samples: usize, purposes: usize) -> Vec<usize> {
    let is_coprime = |stride: &usize| {
        let (mut a, mut b) = (samples, *stride);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let coprime: Vec<usize> = (1..=samples).filter(is_coprime).collect();
    // About the golden ratio apart.
    (0..purposes).map(|purpose| coprime[(purpose * coprime.len() * 618 / 1000) % coprime.len()]).collect()
}
