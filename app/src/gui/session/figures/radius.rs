//! How reflectances become distances in a polar plot.

use serde::{Deserialize, Serialize};

/// What the radius of a polar plot says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Radius {
    /// f_r itself.
    Linear,
    /// Its cube root.
    CubeRoot,
    /// log₁₀(1 + 1000 f_r).
    Logarithm,
}

impl Radius {
    /// All, with their names.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::Linear, "f_r"), (Self::CubeRoot, "cube root"), (Self::Logarithm, "logarithm")];

    /// The radius of a reflectance \[1/sr\].
    pub fn of(self, f: f64) -> f64 {
        match self {
            Self::Linear => f,
            Self::CubeRoot => f.cbrt(),
            Self::Logarithm => (1000.0 * f).ln_1p() / std::f64::consts::LN_10,
        }
    }

    /// The reflectance \[1/sr\] of a radius.
    pub fn back(self, radius: f64) -> f64 {
        match self {
            Self::Linear => radius,
            Self::CubeRoot => radius.powi(3),
            Self::Logarithm => (radius * std::f64::consts::LN_10).exp_m1() / 1000.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_tell_reflectances() {
        for (radius, _) in Radius::ALL {
            for f in [0.0, 1e-3, 0.3, 50.0] {
                assert!((radius.back(radius.of(f)) - f).abs() <= 1e-9 * (1.0 + f), "{radius:?} {f}");
            }
        }
    }
}
