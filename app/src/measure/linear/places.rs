//! Where points of a linear space are judged: the metrics' own directions, all in one list.

use nbrdf_core::sampling::{Quadrature, around_mirror, rus32k};
use nbrdf_core::{Directions, Rgb};

/// Viewers of `albedo_max` \[degrees\], as in PROTOCOL.
const VIEWERS: std::ops::RangeInclusive<u16> = 0..=17;
const STEP: u16 = 5;

/// What logarithms of f cos θ_i + 10⁻³ do not tell from black \[1/sr\], and a little for rounding.
const UNRESOLVED: f64 = 1.01e-3;

/// `rus32k`, then the lights around the mirror direction of every viewer.
pub struct Places {
    at: Vec<Directions>,
    /// Weights of every viewer's lights.
    weights: Vec<Vec<f64>>,
}

/// What is physical about values at the places.
pub struct Physics {
    /// Share of `rus32k` below 0 in any channel.
    pub negative_share: f64,
    /// Share of `rus32k` where f cos θ_i is below −10⁻³ in any channel: more than logarithms resolve.
    pub clearly_negative_share: f64,
    /// Lowest f cos θ_i over `rus32k` \[1/sr\].
    pub lowest: f64,
    /// As the metric of that name, of the values clamped at zero.
    pub albedo_max: f64,
}

impl Places {
    /// All places.
    pub fn new() -> Self {
        let (mut at, mut weights) = (rus32k().to_vec(), Vec::new());
        for viewer in VIEWERS {
            let lights: Quadrature = around_mirror(f32::from(viewer * STEP).to_radians());
            at.extend(lights.at);
            weights.push(lights.weights);
        }
        Self { at, weights }
    }

    /// The pairs.
    pub fn at(&self) -> &[Directions] {
        &self.at
    }

    /// Judges f_r \[1/sr\] at every pair, not yet clamped at zero.
    pub fn judge(&self, signed: &[Rgb]) -> Physics {
        let (metric, mut rest) = signed.split_at(rus32k().len());
        // NaN counts as below.
        let negative = metric.iter().filter(|f| !f.0.iter().all(|&f| f >= 0.0)).count();
        let lowest = || metric.iter().zip(rus32k()).map(|(f, at)| f64::from(f.min() * at.light.z));
        let clearly_negative = lowest().filter(|f| *f < -UNRESOLVED).count();
        let mut albedo_max = 0.0f64;
        for weights in &self.weights {
            let (lights, after) = rest.split_at(weights.len());
            rest = after;
            let mut sum = [0.0f64; 3];
            for (f, weight) in lights.iter().zip(weights) {
                sum.iter_mut().zip(f.0).for_each(|(sum, f)| *sum += f64::from(f.max(0.0)) * weight);
            }
            albedo_max = sum.into_iter().fold(albedo_max, f64::max);
        }
        Physics {
            negative_share: negative as f64 / metric.len() as f64,
            clearly_negative_share: clearly_negative as f64 / metric.len() as f64,
            lowest: lowest().fold(f64::INFINITY, f64::min),
            albedo_max,
        }
    }
}
