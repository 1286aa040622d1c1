//! How much one sample tells: relative variance of a material's samplers, to compare them at equal samples.
//!
//! V = Var\[f̄ cos θ_i / p\] / E², the mean over viewers at θ_o = 0, 10, ..., 80°, under white light, f̄ the mean of red,
//! green and blue. N samples have V / N: a sampler of half the variance needs half the samples. 0 is perfect.

use rand::RngExt;
use serde::{Deserialize, Serialize};

use super::blinn_phong::BlinnPhong;
use super::lobe::Lobe;
use super::outgoing::{Outgoing, viewers};
use super::{Sampler, cosine::Cosine, uniform::Uniform};
use crate::{Brdf, Directions, Rgb, Vec3, direction::spherical, nbrdf::fit::generator};

/// Relative variances of one material by sampler, and the fitted lobe.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Variances {
    /// Name of the material.
    pub name: String,
    /// Of [`Uniform`].
    pub uniform: f64,
    /// Of [`Cosine`].
    pub cosine: f64,
    /// Of the fitted [`BlinnPhong`].
    pub blinn_phong: f64,
    /// Of the fitted [`Lobe`].
    pub lobe: f64,
    /// The fitted lobe.
    pub fitted: Lobe,
}

impl Variances {
    /// Of this material.
    pub fn of(name: &str, brdf: &dyn Brdf) -> Self {
        let fitted = Lobe::fit(brdf);
        Self {
            name: name.to_owned(),
            uniform: relative_variance(brdf, &Uniform),
            cosine: relative_variance(brdf, &Cosine),
            blinn_phong: relative_variance(brdf, &BlinnPhong::fit(brdf)),
            lobe: relative_variance(brdf, &fitted),
            fitted,
        }
    }
}

/// V by quadrature over 2304 lights per viewer. 0 for a black material, infinite for one that is not finite.
pub fn relative_variance(brdf: &dyn Brdf, sampler: &dyn Sampler) -> f64 {
    let Some(seen) = Outgoing::towards_viewers(brdf) else { return f64::INFINITY };
    let variance = |outgoing: &Outgoing| outgoing.second_moment(|at| f64::from(sampler.pdf(at))) - 1.0;
    seen.iter().map(variance).sum::<f64>() / seen.len().max(1) as f64
}

/// V as `samples` samples per viewer show it; NaN for one that is not finite. Same seed, same bits.
pub fn sampled_variance(brdf: &dyn Brdf, sampler: &dyn Sampler, samples: usize, seed: u64) -> f64 {
    let (mut total, mut seen) = (0.0, 0.0);
    for degrees in viewers() {
        let view = spherical((degrees as f32).to_radians(), 0.0);
        let (mut sum, mut squares) = (0.0, 0.0);
        for estimate in estimates(brdf, sampler, view, samples, seed) {
            let mean = f64::from(estimate.mean());
            sum += mean;
            squares += mean * mean;
        }
        if sum != 0.0 {
            total += squares / sum * (samples as f64 / sum) - 1.0;
            seen += 1.0;
        }
    }
    if seen > 0.0 { total / seen } else { 0.0 }
}

/// One-sample estimates f_r cos θ_i / p of the directional albedo for a viewer above the surface: their mean is its
/// albedo whatever the sampler, their spread is not. Same seed, same bits.
pub fn estimates(brdf: &dyn Brdf, sampler: &dyn Sampler, view: Vec3, samples: usize, seed: u64) -> Vec<Rgb> {
    let rng = &mut generator(seed, 0);
    let drawn: Vec<_> = (0..samples).map(|_| sampler.sample(view, [rng.random(), rng.random()])).collect();
    let at: Vec<_> = drawn.iter().map(|sample| Directions::new(sample.light, view)).collect();
    let mut values = vec![Rgb::BLACK; samples];
    brdf.eval_into(&at, &mut values);
    values.iter().zip(drawn).map(|(&value, sample)| value * (sample.light.z / sample.pdf)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{ggx::Ggx, lambert::Lambert};

    #[test]
    fn the_cosine_is_perfect_for_lambert_and_uniform_has_a_third() {
        // ∫ cos² θ 2π dω / π² = 4/3.
        let white = Lambert { albedo: Rgb([0.9, 0.5, 0.1]) };
        assert!(relative_variance(&white, &Cosine).abs() < 1e-6);
        assert!((relative_variance(&white, &Uniform) - 1.0 / 3.0).abs() < 1e-4);
    }

    #[test]
    fn quadrature_and_samples_agree() {
        let plastic = Ggx { diffuse: Rgb([0.4, 0.2, 0.1]), f0: Rgb::splat(0.04), alpha: 0.3 };
        let samplers: [&dyn Sampler; 4] = [&Uniform, &Cosine, &BlinnPhong::fit(&plastic), &Lobe::fit(&plastic)];
        for (k, sampler) in samplers.into_iter().enumerate() {
            let exact = relative_variance(&plastic, sampler);
            let sampled = sampled_variance(&plastic, sampler, 300_000, 7);
            assert!((sampled / exact - 1.0).abs() < 0.05, "sampler {k}: {exact} by quadrature, {sampled} by samples");
        }
    }

    #[test]
    fn a_black_material_has_no_variance_and_one_that_is_not_finite_any() {
        struct Broken;
        impl Brdf for Broken {
            fn eval(&self, _: Directions) -> Rgb {
                Rgb::splat(f32::NAN)
            }
        }
        assert_eq!(relative_variance(&Lambert { albedo: Rgb::BLACK }, &Cosine), 0.0);
        assert_eq!(sampled_variance(&Lambert { albedo: Rgb::BLACK }, &Cosine, 100, 0), 0.0);
        assert_eq!(relative_variance(&Broken, &Cosine), f64::INFINITY);
        assert!(sampled_variance(&Broken, &Cosine, 100, 0).is_nan());
        assert_eq!(sampled_variance(&Broken, &Cosine, 0, 0), 0.0);
    }
}
