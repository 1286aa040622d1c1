//! What a model took.

use nbrdf_core::cost::Cost;
use nbrdf_core::metric::Spread;
use serde::{Deserialize, Serialize};

/// Times of one material, or medians over materials or runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Nanoseconds per evaluation, one thread.
    pub ns: f64,
    /// How many times the plain loop over the weights takes as long.
    pub ratio_to_reference_loop: f64,
    /// Seconds to encode one material.
    pub encode_s: f64,
}

impl Times {
    /// Of evaluation and encoding.
    pub const fn of(Cost { ns, ratio_to_reference_loop }: Cost, encode_s: f64) -> Self {
        Self { ns, ratio_to_reference_loop, encode_s }
    }

    /// The median, figure by figure; none of none.
    pub fn median(all: &[Self]) -> Option<Self> {
        let of = |figure: fn(&Self) -> f64| {
            Spread::new(all.iter().map(|times| ("", figure(times))), false).map(|spread| spread.median)
        };
        Some(Self {
            ns: of(|times| times.ns)?,
            ratio_to_reference_loop: of(|times| times.ratio_to_reference_loop)?,
            encode_s: of(|times| times.encode_s)?,
        })
    }

    /// Whether it could have been measured: finite numbers above 0.
    pub fn is_sound(&self) -> bool {
        [self.ns, self.ratio_to_reference_loop, self.encode_s].iter().all(|v| v.is_finite() && *v > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_has_a_median_of_its_own() {
        let run = |ns, ratio_to_reference_loop, encode_s| Times { ns, ratio_to_reference_loop, encode_s };
        let runs = [run(1.0, 30.0, 0.2), run(3.0, 10.0, 0.3), run(2.0, 20.0, 9.0)];
        assert_eq!(Times::median(&runs), Some(run(2.0, 20.0, 0.3)));
        assert_eq!(Times::median(&[]), None);
        assert!(runs.iter().all(Times::is_sound) && !run(0.0, 1.0, 1.0).is_sound());
    }
}
