//! Networks of materials that change when they are turned.
//!
//! The same 6-21-21-3 network (A. Sztrajman et al., *Neural BRDF Representation and Importance Sampling*, 2021, section 3)
//! with the half vector as it is: (h.x, h.y, h.z) in place of (sin θ_half, 0, cos θ_half). The difference vector is in the
//! half vector's frame either way. Codes, paths and libraries are of isotropic networks: this one is fitted, kept in a
//! file of its own, evaluated and rendered.

use super::Nbrdf;
use super::kernel::{self, Sign};
use crate::brdf::{Azimuth, Prepared};
use crate::simd::InstructionSet;
use crate::{Brdf, Directions, Rgb};

/// A network that reads φ_half.
#[derive(Clone, Debug, PartialEq)]
pub struct AnisotropicNbrdf(Nbrdf);

impl AnisotropicNbrdf {
    /// Takes the weights of a network for those of one that reads φ_half.
    pub const fn of(weights: Nbrdf) -> Self {
        Self(weights)
    }

    /// Hidden widths.
    pub const fn hidden(&self) -> [usize; 2] {
        self.0.hidden()
    }

    /// Flattened weights.
    pub fn weights(&self) -> &[f32] {
        self.0.weights()
    }

    /// The same weights, as those of a network that reads no φ_half.
    pub(crate) const fn network(&self) -> &Nbrdf {
        &self.0
    }

    fn forward(&self, sign: Sign, at: &[Directions], out: &mut [Rgb]) {
        kernel::forward(InstructionSet::fastest(), &self.0.packed, sign, (at, Azimuth::Kept), out);
    }
}

impl Brdf for AnisotropicNbrdf {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_into(&[at], &mut out);
        out[0]
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.forward(Sign::Clamped, at, out);
    }

    fn eval_prepared(&self, at: &Prepared, out: &mut [Rgb]) {
        match at.azimuth() {
            Azimuth::Kept => {
                let set = InstructionSet::fastest();
                kernel::forward_blocks(set, &self.0.packed, Sign::Clamped, at.blocks(), out);
            }
            Azimuth::Dropped => self.eval_into(at.directions(), out),
        }
    }

    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.forward(Sign::Kept, at, out);
    }
}

#[cfg(test)]
mod tests {
    use super::super::fit::{FitOptions, fit_anisotropic, random_network};
    use super::*;
    use crate::direction::turned;
    use crate::metric::log_error;
    use crate::sampling::{evaluate, rus32k};

    /// GGX, three times as rough across the brush as along it.
    struct Brushed;

    impl Brdf for Brushed {
        fn eval(&self, at: Directions) -> Rgb {
            if !at.is_above() {
                return Rgb::BLACK;
            }
            let half = (at.light + at.view).normalize();
            let spread = (half.x / 0.15).powi(2) + (half.y / 0.45).powi(2) + half.z * half.z;
            let lobe = 0.2 / (spread * spread * at.light.z.max(0.2) * at.view.z.max(0.2));
            Rgb([0.9, 0.6, 0.3]).map(|f| 0.02 + f * lobe)
        }
    }

    /// Pairs of all azimuths.
    fn around() -> Vec<Directions> {
        rus32k().iter().step_by(9).zip(0..).map(|(&at, i)| turned(at, i as f32)).collect()
    }

    #[test]
    fn the_kernel_reads_what_the_obvious_loop_reads() {
        let network = random_network(3, 0);
        let turning = AnisotropicNbrdf(network.clone());
        let all = around();
        let prepared = Prepared::keeping_azimuth(all.clone());
        let (mut from_blocks, mut values) = (vec![Rgb::BLACK; all.len()], vec![Rgb::BLACK; all.len()]);
        turning.eval_prepared(&prepared, &mut from_blocks);
        turning.eval_signed_into(&all, &mut values);
        for ((&at, value), from_blocks) in all.iter().zip(values).zip(from_blocks) {
            let plain = kernel::forward_plainly(&network, at.turning_half_diff());
            for channel in 0..3 {
                let found = f64::from(value[channel]);
                assert!((found - plain[channel]).abs() < 1e-4 * (1.0 + plain[channel].abs()), "{at:?}: {value:?}");
                assert_eq!(from_blocks[channel], value[channel].max(0.0), "{at:?}");
            }
        }
        // An isotropic network asked with the same preparation still reads no azimuth.
        let mut isotropic = vec![Rgb::BLACK; all.len()];
        network.eval_prepared(&prepared, &mut isotropic);
        assert_eq!(isotropic, evaluate(&network, &all));
    }

    #[test]
    fn a_fit_that_keeps_the_azimuth_follows_a_brush_that_others_miss() {
        let options = FitOptions { steps: 1500, ..FitOptions::default() };
        let start = random_network(0, 0);
        let kept = fit_anisotropic(&start, &Brushed, options, &|| false).unwrap();
        let dropped = super::super::fit::fit(&start, &Brushed, options, &|| false).unwrap();
        let (at, truth) = (around(), evaluate(&Brushed, &around()));
        let [kept, dropped] = [&kept as &dyn Brdf, &dropped].map(|own| log_error(&at, &truth, &evaluate(own, &at)));
        println!("log_error all around: azimuth kept {kept:.4}, dropped {dropped:.4}");
        assert!(kept < 0.6 * dropped, "{kept} {dropped}");
    }
}
