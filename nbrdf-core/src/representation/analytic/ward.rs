//! A diffuse base under Ward's lobe: seven numbers, ln k_d and ln k_s of each channel, and the logit of ln α.

use super::Parametric;
use super::microfacet::{WIDTHS, solve_together};
use super::number::{log_between, of_log_between, of_positive, positive_rgb};
use super::target::Target;
use crate::brdf::ward::Ward;
use crate::{Brdf, Rgb};

/// Where α may be.
const ALPHA: [f32; 2] = [1e-3, 2.0];

/// A base under Ward's lobe.
pub struct WardLobe;

impl Parametric for WardLobe {
    const NAME: &'static str = "lambert_ward";
    const DIM: usize = 7;

    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf> {
        Box::new(Ward {
            diffuse: positive_rgb(&numbers[..3]),
            specular: positive_rgb(&numbers[3..6]),
            alpha: log_between(numbers[6], ALPHA),
        })
    }

    fn fit(target: &Target) -> Vec<f32> {
        let base = target.base();
        let start = |alpha: f32| {
            let shape = Ward { diffuse: Rgb::BLACK, specular: Rgb::splat(1.0), alpha };
            let lobe = target.brightness(base, &shape).map(|specular| specular.max(1e-3));
            let diffuse = Target::albedo(base);
            let logarithms = [diffuse, lobe].into_iter().flat_map(|rgb| rgb.map(of_positive).0);
            logarithms.chain([of_log_between(alpha, ALPHA)]).collect()
        };
        solve_together::<Self>(target, &WIDTHS.map(start))
    }
}
