//! The hemisphere in bins of polar angle and azimuth, fine around the mirror direction of a viewer.

#![allow(dead_code)] // every test uses its own part

use std::f64::consts::{FRAC_PI_2, PI};

use nbrdf_core::{Directions, Sampler, Vec3, direction::spherical};

/// Bins on either side of the mirror direction, in polar angle and in azimuth.
const BINS: usize = 12;
/// Points per bin and axis of the midpoint rule.
const POINTS: usize = 16;

/// Bins around the mirror direction of one viewer.
pub struct Bins {
    /// The viewer.
    pub view: Vec3,
    phi_o: f64,
    polar: Vec<f64>,
    azimuth: Vec<f64>,
}

impl Bins {
    /// For a viewer at polar angle and azimuth \[rad\], with bins about `width` wide next to the mirror direction.
    pub fn new(theta_o: f64, phi_o: f64, width: f64) -> Self {
        let across = PI.min(2.0 * width * theta_o.cos() / theta_o.sin().max(width));
        Self {
            view: spherical(theta_o as f32, phi_o as f32),
            phi_o,
            polar: graded(theta_o, [0.0, FRAC_PI_2], width),
            azimuth: graded(0.0, [-PI, PI], across),
        }
    }

    /// Lights and their solid angles \[sr\], `POINTS`² per bin. Edges of bins lie on θ_i = θ_o, where folded lobes jump.
    pub fn points(&self) -> (Vec<Directions>, Vec<f64>) {
        let cells =
            self.polar.windows(2).flat_map(|polar| self.azimuth.windows(2).map(move |azimuth| (polar, azimuth)));
        let points = cells.flat_map(|(polar, azimuth)| {
            let (step, turn) = ((polar[1] - polar[0]) / POINTS as f64, (azimuth[1] - azimuth[0]) / POINTS as f64);
            (0..POINTS * POINTS).map(move |k| {
                let theta = polar[0] + step * ((k / POINTS) as f64 + 0.5);
                let phi = azimuth[0] + turn * ((k % POINTS) as f64 + 0.5) + self.phi_o + PI;
                let light = glam::DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
                (Directions::new(light.as_vec3(), self.view), theta.sin() * step * turn)
            })
        });
        points.unzip()
    }

    /// ∫ p dω_i over each bin, for the density p of a sampler.
    pub fn masses(&self, sampler: &dyn Sampler) -> Vec<f64> {
        let (at, solid_angle) = self.points();
        let masses: Vec<f64> = at.iter().zip(solid_angle).map(|(&at, dw)| f64::from(sampler.pdf(at)) * dw).collect();
        masses.chunks(POINTS * POINTS).map(|bin| bin.iter().sum()).collect()
    }

    /// How many lights fall into each bin.
    pub fn counts(&self, lights: impl Iterator<Item = Vec3>) -> Vec<u32> {
        let mut counts = vec![0; (self.polar.len() - 1) * (self.azimuth.len() - 1)];
        for light in lights {
            let light = light.as_dvec3();
            let (sin, cos) = self.phi_o.sin_cos();
            // From the mirror direction, which is opposite to the view.
            let phi = (light.x * sin - light.y * cos).atan2(-light.x * cos - light.y * sin);
            let theta = light.x.hypot(light.y).atan2(light.z);
            counts[place(&self.polar, theta) * (self.azimuth.len() - 1) + place(&self.azimuth, phi)] += 1;
        }
        counts
    }
}

fn place(edges: &[f64], x: f64) -> usize {
    edges.partition_point(|&edge| edge <= x).clamp(1, edges.len() - 1) - 1
}

/// Edges over an interval, about `scale` apart next to `centre` and ever wider away from it.
fn graded(centre: f64, [low, high]: [f64; 2], scale: f64) -> Vec<f64> {
    let side = |length: f64| {
        let reach = (length / scale).asinh();
        (1..=BINS).map(move |k| scale * (reach * k as f64 / BINS as f64).sinh()).take_while(move |_| length > 0.0)
    };
    let below = side(centre - low).map(|x| centre - x);
    let mut edges: Vec<f64> = below.chain([centre]).chain(side(high - centre).map(|x| centre + x)).collect();
    edges.sort_by(f64::total_cmp);
    edges
}
