//! A material's highlight and its base in two numbers, to draw lights from.
//!
//! p = s p_GGX + (1 − s) cos θ_i / π: the visible normals of a GGX surface over a cosine base. After A. Sztrajman,
//! G. Rainer, T. Ritschel, T. Weyrich, *Neural BRDF Representation and Importance Sampling* (2021, doi
//! 10.1111/cgf.14335), section on importance sampling: an analytic model is sampled in place of the network. Differs
//! from the paper: nothing is lost below the horizon, the share s grows towards grazing views as Fresnel reflection
//! does, and the two numbers come from minimising variance ([`Lobe::fit`]), not from fitting reflectance.

use serde::{Deserialize, Serialize};

use super::mixture;
use super::visible_normals::VisibleNormals;
use super::{Sample, Sampler};
use crate::{Directions, Vec3};

pub use super::mixture::MAX_SHARE;

/// Smallest width; narrower than any material at hand by a factor of five, and far from the end of f32.
pub const MIN_WIDTH: f32 = 1e-3;
/// Largest width: that of a GGX surface whose normals lie everywhere alike in the projected disk.
pub const MAX_WIDTH: f32 = 1.0;

/// A glossy lobe over a cosine base. Values out of range are taken as the nearest in range, NaN as the smallest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lobe {
    /// Share of samples drawn from the glossy lobe by a viewer facing the normal, 0..[`MAX_SHARE`].
    pub share: f32,
    /// α of the GGX surface whose reflections the lobe draws, [`MIN_WIDTH`]..[`MAX_WIDTH`].
    pub width: f32,
}

impl Lobe {
    /// No lobe at all: lights in proportion to the cosine.
    pub const COSINE: Self = Self { share: 0.0, width: MAX_WIDTH };

    fn glossy(self) -> VisibleNormals {
        VisibleNormals { alpha: f64::from(mixture::nearest_in([MIN_WIDTH, MAX_WIDTH], self.width)) }
    }
}

impl Sampler for Lobe {
    fn sample(&self, view: Vec3, u: [f32; 2]) -> Sample {
        mixture::sample(&self.glossy(), self.share, view, u)
    }

    fn pdf(&self, at: Directions) -> f32 {
        mixture::pdf_at(&self.glossy(), self.share, at)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::direction::spherical;
    use crate::sampler::cosine::Cosine;

    #[test]
    fn without_a_share_it_is_the_cosine() {
        let view = spherical(1.2, 0.7);
        for u in [[0.0, 0.0], [0.3, 0.9], [0.999, 0.5]] {
            let (lobe, cosine) = (Lobe::COSINE.sample(view, u), Cosine.sample(view, u));
            assert!(lobe.light.distance(cosine.light) < 1e-6 && (lobe.pdf / cosine.pdf - 1.0).abs() < 1e-5);
        }
    }

    #[test]
    fn a_viewer_below_the_surface_still_gets_a_direction() {
        let lobe = Lobe { share: 0.5, width: 0.1 };
        for view in [-Vec3::Z, Vec3::X, Vec3::ZERO, Vec3::NAN] {
            let Sample { light, pdf } = lobe.sample(view, [0.2, 0.4]);
            assert!(light.z > 0.0 && pdf > 0.0);
            assert_eq!(lobe.pdf(Directions::new(light, view)), 0.0);
        }
    }

    proptest! {
        #[test]
        fn samples_are_unit_vectors_above_the_surface_with_the_density_that_pdf_gives(
            share in 0.0..1.1_f32, log_width in -7.5..0.2_f32, grazing in -3.0..1.96_f32, phi in -3.2..3.2_f32,
            u in 0.0..1.0_f32, v in 0.0..1.0_f32,
        ) {
            let lobe = Lobe { share, width: log_width.exp() };
            let view = spherical((90.0 - 10f32.powf(grazing)).max(0.0).to_radians(), phi);
            let Sample { light, pdf } = lobe.sample(view, [u, v]);
            prop_assert!((light.length() - 1.0).abs() < 1e-6 && light.z > 0.0, "{light}");
            prop_assert!(pdf.is_finite() && pdf > 0.0);
            prop_assert!((lobe.pdf(Directions::new(light, view)) / pdf - 1.0).abs() < 1e-3);
        }

        #[test]
        fn nothing_is_drawn_from_below_either_horizon(theta in 1.5709..3.1_f32, share in 0.0..1.0_f32, width in 0.0..1.0_f32) {
            let lobe = Lobe { share, width };
            let (above, below) = (spherical(0.4, 1.0), spherical(theta, 2.0));
            prop_assert_eq!(lobe.pdf(Directions::new(below, above)), 0.0);
            prop_assert_eq!(lobe.pdf(Directions::new(above, below)), 0.0);
        }

        #[test]
        fn no_argument_panics(bits in prop::array::uniform7(any::<u32>())) {
            let [share, width, x, y, z, u, v] = bits.map(f32::from_bits);
            let lobe = Lobe { share, width };
            let drawn = lobe.sample(Vec3::new(x, y, z), [u, v]);
            lobe.pdf(Directions::new(drawn.light, Vec3::new(x, y, z)));
        }
    }
}
