//! What makes many materials of few: random changes that keep a material a material.

use nbrdf_core::Rgb;
use rand::{Rng, RngExt};

/// Largest ln(1 + f) of a blend that goes beyond its materials.
const BRIGHTEST: f32 = 9.0;

/// A random change that keeps a material a material: a blend with another one, sometimes a little beyond either, mixed
/// and scaled channels.
pub(super) struct Change {
    blend: f32,
    /// Rows: how much of each old channel a new channel takes.
    channels: [[f32; 3]; 3],
    scale: [f32; 3],
}

impl Change {
    /// Draws one.
    pub(super) fn random(rng: &mut impl Rng) -> Self {
        let blend = if rng.random_range(0.0..1.0) < 0.5 { rng.random_range(-0.2..1.2f32) } else { 0.0 };
        let mut channels = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if rng.random_range(0.0..1.0) < 0.3 {
            let keep: f32 = rng.random_range(0.0..1.0);
            for (own, row) in channels.iter_mut().enumerate() {
                let other: [f32; 3] = std::array::from_fn(|_| rng.random_range(0.01..1.0f32));
                let sum: f32 = other.iter().sum();
                *row = std::array::from_fn(|c| keep * f32::from(u8::from(c == own)) + (1.0 - keep) * other[c] / sum);
            }
        }
        let mut scale = [1.0; 3];
        if rng.random_range(0.0..1.0) < 0.5 {
            let common: f32 = rng.random_range(-0.5..0.8);
            scale = std::array::from_fn(|_| (common + rng.random_range(-0.4..0.4f32)).exp());
        }
        Self { blend, channels, scale }
    }

    /// From y = ln(1 + f) of two materials to f of the changed one.
    pub(super) fn apply(&self, a: &[Rgb], b: &[Rgb]) -> Vec<Rgb> {
        let one = |(a, b): (&Rgb, &Rgb)| {
            let y = a.zip(*b, |a, b| (a + self.blend * (b - a)).clamp(0.0, BRIGHTEST));
            let channel = |c: usize| {
                let [r, g, b] = self.channels[c];
                self.scale[c] * (r * y[0] + g * y[1] + b * y[2]).exp_m1()
            };
            Rgb(std::array::from_fn(channel))
        };
        a.iter().zip(b).map(one).collect()
    }
}
