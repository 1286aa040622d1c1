//! A diffuse base under an ABC lobe: nine numbers, ln k_d and ln A of each channel, and the logits of ln B, of ln C and
//! of the logarithm of the index of refraction.

use super::Parametric;
use super::microfacet::solve_together;
use super::number::{log_between, of_log_between, of_positive, positive_rgb};
use super::target::Target;
use crate::brdf::abc::Abc;
use crate::{Brdf, Rgb};

const B: [f32; 2] = [1.0, 1e8];
const C: [f32; 2] = [0.02, 20.0];
const IOR: [f32; 2] = [1.01, 100.0];

/// A base under an ABC lobe.
pub struct AbcLobe;

impl Parametric for AbcLobe {
    const NAME: &'static str = "abc";
    const DIM: usize = 9;

    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf> {
        Box::new(Abc {
            diffuse: positive_rgb(&numbers[..3]),
            a: positive_rgb(&numbers[3..6]),
            b: log_between(numbers[6], B),
            c: log_between(numbers[7], C),
            ior: log_between(numbers[8], IOR),
        })
    }

    fn fit(target: &Target) -> Vec<f32> {
        let base = target.base();
        let start = |b: f32| {
            let shape = Abc { diffuse: Rgb::BLACK, a: Rgb::splat(1.0), b, c: 1.3, ior: 1.6 };
            let a = target.brightness(base, &shape).map(|a| a.max(1e-3));
            let diffuse = Target::albedo(base);
            let logarithms = [diffuse, a].into_iter().flat_map(|rgb| rgb.map(of_positive).0);
            let rest = [of_log_between(b, B), of_log_between(shape.c, C), of_log_between(shape.ior, IOR)];
            logarithms.chain(rest).collect()
        };
        solve_together::<Self>(target, &[1e1, 1e2, 1e3, 1e4, 1e5, 1e6].map(start))
    }
}
