//! How much it costs to miss the best lobe: what a network that predicts lobes must be careful about.
//!
//! Around the fitted lobe the mean of ln M (see `outgoing`) is a quadratic in the lobe's coordinates. Where a material has
//! no highlight, its width costs nothing; where it is a mirror, a tenth too narrow or too wide costs much.

use super::fit::{contrast, mean_log_moment};
use super::lobe::{Lobe, MAX_SHARE, MAX_WIDTH, MIN_WIDTH};
use super::outgoing::Outgoing;
use super::visible_normals::VisibleNormals;
use crate::Brdf;

/// Shares are kept this far from 0 and from the largest one, relative to it: their logits stay within 5.3.
const MARGIN: f64 = 5e-3;
/// Offset of the differences, in coordinates: wide enough to see over the quadrature's ripples.
const OFFSET: f64 = 0.25;

/// A fitted lobe in coordinates, and the cost of leaving it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Valley {
    /// See [`Lobe::coordinates`].
    pub lowest: [f64; 2],
    /// Second derivatives of the mean of ln M, positive semidefinite: d²/da², d²/da db, d²/db².
    pub curvature: [f64; 3],
}

impl Lobe {
    /// (logit of the share relative to [`MAX_SHARE`], ln of the width): numbers without bounds, for networks to predict.
    pub fn coordinates(self) -> [f64; 2] {
        let share = (f64::from(self.share) / f64::from(MAX_SHARE)).clamp(MARGIN, 1.0 - MARGIN);
        let width = f64::from(self.width.clamp(MIN_WIDTH, MAX_WIDTH));
        [(share / (1.0 - share)).ln(), width.ln()]
    }

    /// The lobe of these coordinates, whatever they are.
    pub fn from_coordinates([logit, log_width]: [f64; 2]) -> Self {
        let share = f64::from(MAX_SHARE) / (1.0 + (-logit).exp());
        let width = log_width.exp().clamp(f64::from(MIN_WIDTH), f64::from(MAX_WIDTH));
        Self { share: share as f32, width: width as f32 }
    }
}

impl Valley {
    /// Of this material; none where it is black or not finite.
    pub fn of(brdf: &dyn Brdf) -> Option<Self> {
        let seen = Outgoing::towards_viewers(brdf).filter(|seen| !seen.is_empty())?;
        let lowest = Lobe::fit(brdf).coordinates();
        // Rows: widths below, at and above the lowest; columns: shares.
        let heights = [-1.0, 0.0, 1.0].map(|b| {
            let width = (lowest[1] + b * OFFSET).exp().clamp(f64::from(MIN_WIDTH), f64::from(MAX_WIDTH));
            let lobe = VisibleNormals { alpha: width };
            let contrasts: Vec<Vec<f64>> = seen.iter().map(|outgoing| contrast(outgoing, &lobe)).collect();
            [-1.0, 0.0, 1.0].map(|a| {
                let share = Lobe::from_coordinates([lowest[0] + a * OFFSET, 0.0]).share;
                mean_log_moment(&seen, &contrasts, f64::from(share))
            })
        });
        let square = OFFSET * OFFSET;
        let [below, at, above] = heights;
        let across = (above[2] - above[0] - below[2] + below[0]) / (4.0 * square);
        let [along_a, along_b] =
            [at[0] - 2.0 * at[1] + at[2], below[1] - 2.0 * at[1] + above[1]].map(|d| (d / square).max(0.0));
        // At the edge of what lobes can do the differences need not be those of a valley.
        let most = (along_a * along_b).sqrt();
        let across = across.clamp(-most, most);
        Some(Self { lowest, curvature: [along_a, across, along_b] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;
    use crate::brdf::{ggx::Ggx, lambert::Lambert};

    #[test]
    fn coordinates_are_those_of_the_lobe() {
        for lobe in [Lobe { share: 0.3, width: 0.02 }, Lobe { share: 0.9, width: 1.0 }] {
            let back = Lobe::from_coordinates(lobe.coordinates());
            assert!((back.share - lobe.share).abs() < 1e-6 && (back.width / lobe.width - 1.0).abs() < 1e-6);
        }
        for wild in [[f64::INFINITY, f64::NEG_INFINITY], [-1e9, 1e9], [f64::NAN, f64::NAN]] {
            let Lobe { share, width } = Lobe::from_coordinates(wild);
            assert!(share.is_nan() || (0.0..=MAX_SHARE).contains(&share), "{share}");
            assert!(width.is_nan() || (MIN_WIDTH..=MAX_WIDTH).contains(&width), "{width}");
        }
    }

    #[test]
    fn the_width_matters_for_a_metal_and_not_for_chalk() {
        let metal = Valley::of(&Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(0.9), alpha: 0.05 }).unwrap();
        let chalk = Valley::of(&Lambert { albedo: Rgb::splat(0.8) }).unwrap();
        assert!(metal.curvature[2] > 0.1 && chalk.curvature[2] < 1e-2, "{metal:?} {chalk:?}");
        for Valley { curvature: [a, across, b], .. } in [metal, chalk] {
            assert!(a >= 0.0 && b >= 0.0 && across * across <= a * b * (1.0 + 1e-9) + 1e-12);
        }
        assert!(Valley::of(&Lambert { albedo: Rgb::BLACK }).is_none());
    }
}
