//! What of a path is shown over t.

use serde::{Deserialize, Serialize};

use crate::worker::Place;

/// What is shown over t.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quantity {
    /// PSNR against the linear mix.
    Psnr,
    /// ΔE_ITP to the linear mix.
    ToMix,
    /// ΔE_ITP from point to point.
    Step,
    /// How far the colour leaves mixtures of the ends'.
    Hue,
    /// Largest directional albedo.
    Albedo,
    /// Share of directions below zero.
    Negative,
}

impl Quantity {
    /// All, with name, unit and what they say.
    pub const ALL: [(Self, &'static str, &'static str, &'static str); 6] = [
        (Self::Psnr, "PSNR to the mix", "dB", "Against the exact linear mix, higher is closer; 100 is exact"),
        (Self::ToMix, "ΔE to the mix", "ΔE_ITP", "To the exact linear mix; one unit is just noticeable"),
        (Self::Step, "Step size", "ΔE_ITP per 1/32 of t", "From point to point; level is even"),
        (Self::Hue, "Hue detour", "u'v'", "How far the mean colour leaves all mixtures of the ends' colours"),
        (Self::Albedo, "Albedo", "largest directional", "Above 1 more light leaves than arrives"),
        (Self::Negative, "Negative share", "% of directions", "Where reflectance is below zero before it is clamped"),
    ];

    /// Its name, its unit.
    pub fn named(self) -> (&'static str, &'static str) {
        let found = Self::ALL.iter().find(|(quantity, ..)| *quantity == self);
        found.map_or(("", ""), |(_, name, unit, _)| (name, unit))
    }

    /// Where it is on the path, and its value.
    pub fn at(self, place: &Place) -> Option<[f64; 2]> {
        let value = match self {
            Self::Step => return place.step,
            Self::Psnr => place.psnr,
            Self::ToMix => place.to_mix,
            Self::Hue => place.hue,
            Self::Albedo => place.albedo,
            Self::Negative => 100.0 * place.negative,
        };
        Some([f64::from(place.t), value])
    }
}
