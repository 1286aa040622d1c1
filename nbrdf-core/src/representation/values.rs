//! Kinds of numbers that linear models hold in their tables, all of a reflectance times a cosine.
//!
//! A linear model minimises squares of what it is given: of f c it sees highlights and nothing else, of logarithms ratios
//! (W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 5; J. Nielsen et al., *On Optimal, Minimal BRDF
//! Sampling for Reflectance Acquisition* (2015), section 4.1).

use serde::{Deserialize, Serialize};

use crate::nbrdf::objective::DARKEST;
use crate::{Directions, Rgb};

/// cos θ_i is never taken as less.
const COSINE_FLOOR: f32 = 0.05;
/// Logarithms above this are taken as this: every table gives finite reflectances.
const LARGEST_LOG: f32 = 80.0;
/// The same for plain values.
const LARGEST_PLAIN: f32 = 1e30;

/// What a number stands for, of a reflectance f \[1/sr\].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Values {
    /// f c, c = cos θ_i floored at 0.05. Nothing keeps sums of such tables from becoming negative.
    Plain,
    /// ln(f c + 10⁻³), c as before (PROTOCOL of this project, "PCA-32").
    Log,
    /// ln((f w + 10⁻³) / (f_ref w + 10⁻³)), w = cos θ_i cos θ_o floored at 10⁻³, f_ref the median of the training
    /// materials at every place (Nielsen et al. 2015, section 4.1). A table holds the numerator alone: the denominator is
    /// the same for all materials, and the centre of what is learned.
    LogRelative,
}

impl Values {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Log, Self::LogRelative];

    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Log => "log",
            Self::LogRelative => "log_relative",
        }
    }

    /// What f is multiplied by, above 0.
    fn cosine(self, at: Directions) -> f32 {
        match self {
            Self::Plain | Self::Log => at.light.z.max(COSINE_FLOOR),
            Self::LogRelative => (at.light.z * at.view.z).max(DARKEST),
        }
    }

    /// The number that stands for `f` \[1/sr\] in one channel.
    pub fn stored(self, at: Directions, f: f32) -> f32 {
        let weighted = f * self.cosine(at);
        match self {
            Self::Plain => weighted,
            Self::Log | Self::LogRelative => (weighted + DARKEST).ln(),
        }
    }

    /// f_r \[1/sr\] that these numbers stand for, not yet clamped at zero; finite for finite numbers.
    pub fn reflectance(self, at: Directions, stored: Rgb) -> Rgb {
        let cosine = self.cosine(at);
        match self {
            Self::Plain => stored.map(|v| v.clamp(-LARGEST_PLAIN, LARGEST_PLAIN) / cosine),
            Self::Log | Self::LogRelative => stored.map(|v| (v.min(LARGEST_LOG).exp() - DARKEST) / cosine),
        }
    }

    /// The middle one of several stored numbers, which are sorted; of two middle ones their mean \[as f\].
    pub(super) fn median(self, sorted: &[f32]) -> f32 {
        let [low, high] = [sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2]];
        match self {
            Self::Plain => 0.5 * (low + high),
            // ln of the mean, without leaving the logarithms.
            Self::Log | Self::LogRelative => high + (0.5 * ((low - high).exp() + 1.0)).ln(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_stored_comes_back() {
        for (theta_i, theta_o) in [(0.1, 1.2), (1.2, 0.1), (0.7, 1.5)] {
            let at = Directions::from_angles(theta_i, 0.0, theta_o, 2.0);
            for values in Values::ALL {
                for f in [0.0, 1e-3, 0.3, 200.0] {
                    let back = values.reflectance(at, Rgb::splat(values.stored(at, f)))[0];
                    // 10⁻³ in the logarithm, and a cosine of 10⁻³ at least.
                    assert!((back - f).abs() < 2e-6 * f + 2e-5, "{} {f}: {back}", values.name());
                }
            }
        }
    }

    #[test]
    fn the_median_of_logarithms_is_the_logarithm_of_the_median() {
        let at = Directions::from_angles(0.4, 0.0, 0.9, 1.0);
        let of = |fs: &[f32]| {
            let stored: Vec<f32> = fs.iter().map(|&f| Values::LogRelative.stored(at, f)).collect();
            Values::LogRelative.reflectance(at, Rgb::splat(Values::LogRelative.median(&stored)))[0]
        };
        assert!((of(&[0.1, 0.4, 90.0]) - 0.4).abs() < 1e-5);
        assert!((of(&[0.0, 0.1, 0.7, 90.0]) - 0.4).abs() < 1e-5);
    }
}
