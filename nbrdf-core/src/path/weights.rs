//! Barycentric weights: one per end, sum 1.

use smallvec::{SmallVec, smallvec};

use super::PathError;
use crate::Warning;

/// Negative weights of splines sum up to less than 1/8 between the ends.
const SPLINE: f32 = 0.13;

/// Weights of the ends of a path; negative ones lie beyond the ends. Up to six are no allocation.
#[derive(Clone, Debug, PartialEq)]
pub struct Weights(SmallVec<[f32; 6]>);

/// Why numbers are not barycentric weights.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("weights {found:?} do not add up to a positive, finite sum")]
pub struct WeightsError {
    /// The numbers given.
    pub found: Vec<f32>,
}

impl Weights {
    /// (1 − t, t): t = 0 is the first of two ends, t = 1 the second.
    pub fn two(t: f32) -> Self {
        Self(smallvec![1.0 - t, t])
    }

    /// Any weights, scaled to the sum 1.
    pub fn normalized(weights: Vec<f32>) -> Result<Self, WeightsError> {
        let sum: f32 = weights.iter().sum();
        if !(sum.is_finite() && sum > 0.0) {
            return Err(WeightsError { found: weights });
        }
        Ok(Self(weights.into_iter().map(|w| w / sum).collect()))
    }

    /// Weights that sum to 1 already.
    pub(crate) const fn summing_to_one(weights: SmallVec<[f32; 6]>) -> Self {
        Self(weights)
    }

    /// On the smooth curve that passes all `ends` in order, t = 0 at the first and 1 at the last: the basis of a
    /// uniform Catmull–Rom spline (E. Catmull, R. Rom 1974), mirrored at the ends and straight beyond them. Works in any
    /// path, since a spline's points are weighted sums.
    pub fn along_spline(t: f32, ends: usize) -> Self {
        let mut weights: SmallVec<[f32; 6]> = smallvec![0.0; ends];
        let Some(last) = ends.checked_sub(1).filter(|last| *last > 0) else { return Self(smallvec![1.0; ends]) };
        let place = t * last as f32;
        // NaN becomes the first piece here, and is refused by what the weights are used for.
        let piece = (place.max(0.0) as usize).min(last - 1);
        let s = place - piece as f32;
        let basis = if (0.0..=1.0).contains(&s) {
            let (s2, s3) = (s * s, s * s * s);
            [
                0.5 * (2.0 * s2 - s - s3),
                0.5 * (3.0 * s3 - 5.0 * s2 + 2.0),
                0.5 * (4.0 * s2 + s - 3.0 * s3),
                0.5 * (s3 - s2),
            ]
        } else {
            [0.0, 1.0 - s, s, 0.0]
        };
        for (offset, share) in basis.into_iter().enumerate() {
            match (piece + offset).checked_sub(1) {
                Some(end) if end <= last => weights[end] += share,
                // A mirrored end: twice the last, less the one before it.
                outside => {
                    let (near, next) = if outside.is_none() { (0, 1) } else { (last, last - 1) };
                    weights[near] += 2.0 * share;
                    weights[next] -= share;
                }
            }
        }
        Self(weights)
    }

    /// How far beyond the ends: the sum of the negative weights.
    pub fn beyond(&self) -> f32 {
        self.0.iter().map(|w| (-w).max(0.0)).sum()
    }

    /// That they are beyond the ends, farther than any spline between them goes.
    pub fn warning(&self) -> Option<Warning> {
        let beyond = self.beyond();
        let within = if self.0.len() == 2 { f32::EPSILON } else { SPLINE };
        (beyond > within).then_some(Warning::Extrapolated { beyond })
    }

    /// The numbers.
    pub fn as_slice(&self) -> &[f32] {
        &self.0
    }

    /// The numbers, if there are as many as ends.
    pub fn for_ends(&self, ends: usize) -> Result<&[f32], PathError> {
        if self.0.len() == ends { Ok(&self.0) } else { Err(PathError::Weights { ends, weights: self.0.len() }) }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_spline_passes_every_key_material() {
        for ends in 2..7 {
            for end in 0..ends {
                let weights = Weights::along_spline(end as f32 / (ends - 1) as f32, ends);
                for (i, w) in weights.as_slice().iter().enumerate() {
                    assert!((w - f32::from(u8::from(i == end))).abs() < 1e-5, "{ends} {end}: {weights:?}");
                }
            }
        }
    }

    #[test]
    fn a_spline_between_two_is_the_straight_path() {
        for t in [-0.5, 0.0, 0.3, 1.0, 1.5] {
            let [found, wanted] = [Weights::along_spline(t, 2), Weights::two(t)];
            let close = |(a, b): (&f32, &f32)| (a - b).abs() < 1e-6;
            assert!(found.as_slice().iter().zip(wanted.as_slice()).all(close), "{found:?} {wanted:?}");
        }
    }

    proptest! {
        #[test]
        fn a_spline_has_no_jumps_and_its_weights_sum_to_one(t in -0.5..1.5f32, ends in 2usize..8) {
            let [here, there] = [t, t + 1e-3].map(|t| Weights::along_spline(t, ends));
            let sum: f32 = here.as_slice().iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-4);
            for (a, b) in here.as_slice().iter().zip(there.as_slice()) {
                prop_assert!((a - b).abs() < 2e-2);
            }
        }
    }
}
