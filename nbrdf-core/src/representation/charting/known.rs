//! Manifolds whose coordinates are known.

use rand::RngExt as _;

use crate::nbrdf::fit::generator;

/// Points in three dimensions and their two coordinates.
pub struct Known {
    pub points: Vec<Vec<f64>>,
    pub coordinates: Vec<Vec<f64>>,
}

/// A rolled-up sheet, one turn, 15 high; the coordinates are the length along the spiral and the height.
/// Noise is uniform within ± `noise`, off the sheet in any direction.
pub fn swiss_roll(count: usize, noise: f64, seed: u64) -> Known {
    let mut random = generator(seed, 1);
    let mut known = Known { points: Vec::new(), coordinates: Vec::new() };
    // Length of the spiral r = t up to t.
    let length = |t: f64| 0.5 * (t * (1.0 + t * t).sqrt() + t.asinh());
    let (first, last) = (1.5 * std::f64::consts::PI, 3.5 * std::f64::consts::PI);
    while known.points.len() < count {
        let (t, height) = (first + (last - first) * random.random::<f64>(), 15.0 * random.random::<f64>());
        // As many points on each piece of the sheet.
        if random.random::<f64>() * (1.0 + last * last).sqrt() > (1.0 + t * t).sqrt() {
            continue;
        }
        let mut shaken = |v: f64| v + noise * (2.0 * random.random::<f64>() - 1.0);
        known.points.push(vec![shaken(t * t.cos()), shaken(height), shaken(t * t.sin())]);
        known.coordinates.push(vec![length(t), height]);
    }
    known
}

/// The part of the unit sphere within 1.2 rad of the pole; the coordinates are polar: angle from the pole in the
/// direction of the azimuth.
pub fn sphere_patch(count: usize, seed: u64) -> Known {
    let mut random = generator(seed, 2);
    let mut known = Known { points: Vec::new(), coordinates: Vec::new() };
    for _ in 0..count {
        let cos = 1.0 - random.random::<f64>() * (1.0 - 1.2f64.cos());
        let (theta, phi) = (cos.acos(), std::f64::consts::TAU * random.random::<f64>());
        known.points.push(vec![theta.sin() * phi.cos(), theta.sin() * phi.sin(), cos]);
        known.coordinates.push(vec![theta * phi.cos(), theta * phi.sin()]);
    }
    known
}
