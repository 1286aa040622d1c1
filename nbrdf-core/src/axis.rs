//! Axes along which materials are edited: each moves one of the measured [`Qualities`] and holds others.

mod edit;

pub use edit::{Prior, edit};

use serde::{Deserialize, Serialize};

use crate::quality::Qualities;

/// Chroma below which a material counts as grey: its hue is rounding.
pub const GREY: f64 = 0.02;

/// A quality that can be moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// How light, highlight included.
    Lightness,
    /// Angle of the colour in u′v′, in turns; grey has none.
    Hue,
    /// Distance of the colour from grey, in tenths of u′v′.
    Chroma,
    /// Strength of the highlight.
    Gloss,
    /// Width of the highlight.
    Roughness,
    /// Share of the highlight in all light.
    Metalness,
    /// Brightening towards grazing angles.
    Sheen,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Lightness, Self::Hue, Self::Chroma, Self::Gloss, Self::Roughness, Self::Metalness, Self::Sheen];

    /// Name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lightness => "lightness",
            Self::Hue => "hue",
            Self::Chroma => "chroma",
            Self::Gloss => "gloss",
            Self::Roughness => "roughness",
            Self::Metalness => "metalness",
            Self::Sheen => "sheen",
        }
    }

    /// The quality itself, as it is asked for: hue in turns.
    pub fn value(self, q: &Qualities) -> f64 {
        match self {
            Self::Lightness => q.lightness,
            Self::Hue => q.colour[1].atan2(q.colour[0]) / std::f64::consts::TAU,
            Self::Chroma => 10.0 * q.colour[0].hypot(q.colour[1]),
            Self::Gloss => q.gloss,
            Self::Roughness => q.roughness,
            Self::Metalness => q.metalness,
            Self::Sheen => q.sheen,
        }
    }

    /// How far this quality moved; a hue the shorter way round.
    pub fn difference(self, from: &Qualities, to: &Qualities) -> f64 {
        let difference = self.value(to) - self.value(from);
        if self == Self::Hue { difference - difference.round() } else { difference }
    }

    /// How much of a move by `amount` was not made; a hue's the shorter way round.
    pub fn missed(self, from: &Qualities, to: &Qualities, amount: f64) -> f64 {
        let missed = amount - self.difference(from, to);
        if self == Self::Hue { missed - missed.round() } else { missed }
    }

    /// What is prescribed, moved quality and held ones. Lightness takes the highlight with it, gloss leaves the body
    /// alone, metalness trades body for highlight: three names for two amounts of light.
    fn rows(self, q: &Qualities) -> [f64; 6] {
        let [u, v] = q.colour.map(|v| 10.0 * v);
        let [first, second] = match self {
            Self::Gloss => [q.gloss, q.body],
            _ => [q.lightness, q.metalness],
        };
        [u, v, q.roughness, q.sheen, first, second]
    }

    /// The prescribed rows when this quality of `from` is moved by `amount`.
    fn wanted(self, from: &Qualities, amount: f64) -> [f64; 6] {
        let mut q = *from;
        match self {
            Self::Lightness => q.lightness += amount,
            Self::Hue => {
                let (sin, cos) = (std::f64::consts::TAU * amount).sin_cos();
                let [u, v] = q.colour;
                q.colour = [cos * u - sin * v, sin * u + cos * v];
            }
            Self::Chroma => {
                let [u, v] = q.colour;
                let length = u.hypot(v);
                // Perfect grey has no direction of its own: it turns red.
                let direction = if length > 1e-6 { [u / length, v / length] } else { [1.0, 0.0] };
                q.colour = direction.map(|d| d * (length + 0.1 * amount).max(0.0));
            }
            Self::Gloss => q.gloss += amount,
            Self::Roughness => q.roughness += amount,
            Self::Metalness => q.metalness += amount,
            Self::Sheen => q.sheen += amount,
        }
        self.rows(&q)
    }
}
