//! How far the mean colour of a material leaves the segment between two others, and its derivative: what training adds
//! so that mixed codes show no colour that is in neither end.

use super::samples::Samples;
use crate::Rgb;
use crate::metric::{chromaticity_and_slopes, detour};
use crate::nbrdf::objective::{first_lamp, radiance};

/// Two colours in u′v′ and all between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corridor(pub [[f64; 2]; 2]);

impl Corridor {
    /// Between the mean colours of two materials, given their reflectances at all samples.
    pub fn between(samples: &Samples, ends: [&[Rgb]; 2]) -> Self {
        Self(ends.map(|values| chromaticity_and_slopes(mean(samples, values)).0))
    }

    /// Distance in u′v′ of the mean colour of these reflectances, and ∂distance/∂f.
    pub fn loss(&self, samples: &Samples, values: &[Rgb], by_value: &mut [Rgb]) -> f64 {
        by_value.fill(Rgb::BLACK);
        let (colour, slopes) = chromaticity_and_slopes(mean(samples, values));
        let away = detour(colour, self.0[0], self.0[1]);
        let distance = away[0].hypot(away[1]);
        if distance < 1e-9 {
            return 0.0;
        }
        let pixels = samples.counts.pixels;
        let by_mean = slopes.map(|slope| (slope[0] * away[0] + slope[1] * away[1]) / distance / pixels as f64);
        for pixel in 0..pixels {
            let radiance = radiance(samples, values, pixel);
            let first = first_lamp(samples, pixel);
            for lamp in first..first + samples.counts.lamps {
                for channel in 0..3 {
                    let moves = radiance[channel] <= 1.0 && values[lamp][channel] > 0.0;
                    let slope = by_mean[channel] as f32 * samples.factors[lamp];
                    by_value[lamp][channel] = if moves { slope } else { 0.0 };
                }
            }
        }
        distance
    }
}

/// Mean of the pixels' radiance, clipped as a display does.
fn mean(samples: &Samples, values: &[Rgb]) -> [f64; 3] {
    let pixels = samples.counts.pixels;
    let clipped = (0..pixels).map(|pixel| radiance(samples, values, pixel).map(|v| v.clamp(0.0, 1.0)));
    let sum = clipped.fold([0.0; 3], |sum, pixel| [0, 1, 2].map(|c| sum[c] + f64::from(pixel[c])));
    sum.map(|sum| sum / pixels.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Brdf;
    use crate::brdf::lambert::Lambert;
    use crate::nbrdf::fit::generator;
    use crate::nbrdf::samples::SampleCounts;

    fn values(samples: &Samples, albedo: [f32; 3]) -> Vec<Rgb> {
        let brdf: &dyn Brdf = &Lambert { albedo: Rgb(albedo) };
        samples.values(brdf)
    }

    #[test]
    fn the_linear_mix_stays_inside_and_another_colour_does_not() {
        let samples = Samples::random(&mut generator(1, 0), SampleCounts::STEP);
        let (red, blue) = (values(&samples, [0.5, 0.1, 0.1]), values(&samples, [0.1, 0.1, 0.4]));
        let corridor = Corridor::between(&samples, [&red, &blue]);
        let mut slopes = vec![Rgb::BLACK; red.len()];
        let mixed: Vec<Rgb> = red.iter().zip(&blue).map(|(a, b)| (*a + *b) * 0.5).collect();
        assert!(corridor.loss(&samples, &mixed, &mut slopes) < 1e-6);
        assert!(corridor.loss(&samples, &values(&samples, [0.1, 0.4, 0.1]), &mut slopes) > 0.05);
    }

    #[test]
    fn the_derivative_is_that_of_differences() {
        let samples = Samples::random(&mut generator(1, 0), SampleCounts::STEP);
        let corridor =
            Corridor::between(&samples, [&values(&samples, [0.5, 0.1, 0.1]), &values(&samples, [0.1, 0.1, 0.4])]);
        let own = values(&samples, [0.1, 0.3, 0.1]);
        let mut slopes = vec![Rgb::BLACK; own.len()];
        let loss = corridor.loss(&samples, &own, &mut slopes);
        for channel in 0..3 {
            let moved: Vec<Rgb> = own
                .iter()
                .map(|f| {
                    let mut f = *f;
                    f[channel] *= 1.001;
                    f
                })
                .collect();
            let expected: f64 = slopes.iter().zip(&own).map(|(s, f)| f64::from(s[channel] * f[channel] * 0.001)).sum();
            let found = corridor.loss(&samples, &moved, &mut vec![Rgb::BLACK; own.len()]) - loss;
            assert!((found - expected).abs() < 0.02 * expected.abs() + 1e-9, "{channel}: {found} {expected}");
        }
    }
}
