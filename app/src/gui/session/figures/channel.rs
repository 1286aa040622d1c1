//! Which number of a colour is shown.

use nbrdf_core::Rgb;
use serde::{Deserialize, Serialize};

/// Of which channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Channel {
    /// Luminance of all three.
    Luminance,
    /// Red.
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
}

impl Channel {
    /// All, with their names.
    pub const ALL: [(Self, &'static str); 4] =
        [(Self::Luminance, "Luminance"), (Self::Red, "Red"), (Self::Green, "Green"), (Self::Blue, "Blue")];

    /// Of a colour.
    pub fn of(self, colour: Rgb) -> f64 {
        match self {
            Self::Luminance => colour.luminance(),
            Self::Red => f64::from(colour[0]),
            Self::Green => f64::from(colour[1]),
            Self::Blue => f64::from(colour[2]),
        }
    }
}
