//! What fitting, refining and training minimize, and its derivative with respect to reflectance.
//!
//! mean |Δ ln(1 + f c)| + a · mean |Δ ln(f c + 10⁻³)| + b · RMS Δ display, with c = cos θ_i. The first term is the loss of
//! Sztrajman et al. (2021), section 3; the second weighs dark materials; the third judges sphere pixels as displayed.

use crate::Rgb;
use crate::nbrdf::samples::Samples;
use crate::simd::{logarithms, powers};

/// What ln(f c + …) adds, so that black has a logarithm.
pub const DARKEST: f32 = 1e-3;
/// Exponent of the display curve.
const DISPLAY: f32 = 1.0 / 2.2;
/// Below this radiance the display curve is taken as straight, so that its slope stays finite.
const DISPLAY_TOE: f32 = 1e-4;

/// Weights of the three terms.
#[derive(Clone, Copy, Debug)]
pub struct Objective {
    /// Of mean |Δ ln(1 + f c)|.
    pub log: f32,
    /// Of mean |Δ ln(f c + 10⁻³)|.
    pub relative: f32,
    /// Of the RMS of displayed pixels.
    pub display: f32,
    /// Take the mean square of displayed pixels instead of its root.
    pub squared: bool,
}

impl Objective {
    /// For fitting networks and training.
    pub const FIT: Self = Self { log: 1.0, relative: 0.2, display: 0.3, squared: false };
    /// The published autoencoder's loss: mean square of displayed pixels alone.
    pub const IMAGE: Self = Self { log: 0.0, relative: 0.0, display: 1.0, squared: true };
    /// For training an autoencoder.
    pub const TRAIN: Self = Self { log: 2.0, ..Self::FIT };
    /// For refining a code.
    pub const REFINE: Self = Self { log: 1.0, relative: 0.2, display: 1.0, squared: false };

    /// The loss between two lists of [`features`]; writes ∂loss/∂feature of `own`.
    ///
    /// # Panics
    /// If the lengths do not fit the samples (a bug of the caller).
    pub fn loss(&self, samples: &Samples, own: &[f32], target: &[f32], derivative: &mut [f32]) -> f64 {
        assert!(own.len() == target.len() && own.len() == derivative.len(), "features of the same samples");
        let [log, relative, display] = sections(samples);
        let mut loss = 0.0;
        for (range, weight) in [(log, self.log), (relative, self.relative)] {
            let scale = weight / range.len().max(1) as f32;
            let mut sum = 0.0;
            for i in range {
                let difference = own[i] - target[i];
                sum += f64::from(difference.abs());
                derivative[i] = if difference == 0.0 { 0.0 } else { scale.copysign(difference) };
            }
            loss += sum * f64::from(scale);
        }
        let count = display.len().max(1) as f32;
        let square: f64 = display.clone().map(|i| f64::from(own[i] - target[i]).powi(2)).sum();
        let mean_square = square / f64::from(count);
        let rms = (mean_square + 1e-12).sqrt();
        let (value, slope) = if self.squared { (mean_square, 2.0) } else { (rms, 1.0 / rms) };
        for i in display {
            derivative[i] = self.display * slope as f32 * (own[i] - target[i]) / count;
        }
        loss + f64::from(self.display) * value
    }

    /// The weight of each feature's squared difference in one step of iteratively reweighted least squares.
    pub fn squared_weights(&self, samples: &Samples, residual: &[f32]) -> Vec<f32> {
        let [log, relative, display] = sections(samples);
        let mut weights = vec![0.0; residual.len()];
        for (range, weight) in [(log, self.log), (relative, self.relative)] {
            let count = range.len().max(1) as f32;
            let typical = range.clone().map(|i| residual[i].abs()).sum::<f32>() / count;
            for i in range {
                weights[i] = weight / (count * residual[i].abs().max(0.1 * typical).max(1e-6));
            }
        }
        let count = display.len().max(1) as f32;
        let rms = (display.clone().map(|i| residual[i] * residual[i]).sum::<f32>() / count).sqrt().max(1e-6);
        for i in display {
            weights[i] = self.display / (count * rms);
        }
        weights
    }
}

/// Features of each kind, three per direction or pixel.
fn sections(samples: &Samples) -> [std::ops::Range<usize>; 3] {
    let counts = samples.counts;
    let log = 3 * counts.log;
    let relative = log + 3 * counts.relative;
    [0..log, log..relative, relative..relative + 3 * counts.pixels]
}

/// Number of [`features`].
pub fn feature_count(samples: &Samples) -> usize {
    sections(samples)[2].end
}

/// The values in the units in which they are compared: ln(1 + f c), ln(f c + 10⁻³), displayed pixels.
pub fn features(samples: &Samples, values: &[Rgb]) -> Vec<f32> {
    let mut out = vec![0.0; feature_count(samples)];
    features_into(samples, values, &mut out);
    out
}

/// As [`features`], into a given slice.
pub fn features_into(samples: &Samples, values: &[Rgb], out: &mut [f32]) {
    let [log, relative, display] = sections(samples);
    let logarithmic = relative.end;
    for i in log {
        out[i] = (1.0 + values[i / 3][i % 3] * samples.factors[i / 3]).max(0.1);
    }
    for i in relative {
        out[i] = (values[i / 3][i % 3] * samples.factors[i / 3]).max(0.0) + DARKEST;
    }
    logarithms(&mut out[..logarithmic]);
    let displayed = &mut out[display];
    for (pixel, out) in displayed.chunks_exact_mut(3).enumerate() {
        out.copy_from_slice(&radiance(samples, values, pixel).map(toe).0);
    }
    powers(displayed, DISPLAY);
    for (pixel, out) in displayed.chunks_exact_mut(3).enumerate() {
        for (out, radiance) in out.iter_mut().zip(radiance(samples, values, pixel).0) {
            if radiance < DISPLAY_TOE {
                *out = radiance * DISPLAY_TOE.powf(DISPLAY - 1.0);
            }
        }
    }
}

/// ∂loss/∂f from ∂loss/∂feature; `values` are those the features came from.
pub fn pull_back(samples: &Samples, values: &[Rgb], own: &[f32], by_feature: &[f32], by_value: &mut [Rgb]) {
    let [log, relative, display] = sections(samples);
    for i in log {
        let (f, c) = (values[i / 3][i % 3], samples.factors[i / 3]);
        by_value[i / 3][i % 3] = by_feature[i] * log_slope(f, c);
    }
    for i in relative {
        let (f, c) = (values[i / 3][i % 3], samples.factors[i / 3]);
        by_value[i / 3][i % 3] = by_feature[i] * relative_slope(f, c);
    }
    for pixel in 0..samples.counts.pixels {
        let at = display.start + 3 * pixel;
        let radiance = radiance(samples, values, pixel);
        let first = first_lamp(samples, pixel);
        for channel in 0..3 {
            let slope = by_feature[at + channel] * display_slope(radiance[channel], own[at + channel]);
            for lamp in first..first + samples.counts.lamps {
                let lit = values[lamp][channel] > 0.0;
                by_value[lamp][channel] = if lit { slope * samples.factors[lamp] } else { 0.0 };
            }
        }
    }
}

/// How the features move when the values do; `values` and `own` are those the features came from.
pub fn push_forward(samples: &Samples, values: &[Rgb], own: &[f32], moved: &[Rgb], out: &mut [f32]) {
    let [log, relative, display] = sections(samples);
    for i in log {
        let (f, c) = (values[i / 3][i % 3], samples.factors[i / 3]);
        out[i] = moved[i / 3][i % 3] * log_slope(f, c);
    }
    for i in relative {
        let (f, c) = (values[i / 3][i % 3], samples.factors[i / 3]);
        out[i] = moved[i / 3][i % 3] * relative_slope(f, c);
    }
    for pixel in 0..samples.counts.pixels {
        let at = display.start + 3 * pixel;
        let radiance = radiance(samples, values, pixel);
        let first = first_lamp(samples, pixel);
        let lamps = first..first + samples.counts.lamps;
        for channel in 0..3 {
            let lit = lamps.clone().filter(|&lamp| values[lamp][channel] > 0.0);
            let change: f32 = lit.map(|lamp| moved[lamp][channel] * samples.factors[lamp]).sum();
            out[at + channel] = change * display_slope(radiance[channel], own[at + channel]);
        }
    }
}

/// Slope of ln(1 + f c) over f; a value far below 0 keeps one, or it could never come back.
fn log_slope(f: f32, c: f32) -> f32 {
    c / (1.0 + f * c).max(0.1)
}

/// Slope of ln(f c + 10⁻³) over f; none below 0, where the other terms draw it up.
fn relative_slope(f: f32, c: f32) -> f32 {
    if f > 0.0 { c / (f * c + DARKEST) } else { 0.0 }
}

/// Where the lamps of a sampled pixel begin.
pub(super) fn first_lamp(samples: &Samples, pixel: usize) -> usize {
    samples.counts.log + samples.counts.relative + samples.counts.lamps * pixel
}

/// Radiance of a sampled pixel: its lamps summed.
pub(super) fn radiance(samples: &Samples, values: &[Rgb], pixel: usize) -> Rgb {
    let first = first_lamp(samples, pixel);
    (first..first + samples.counts.lamps)
        .fold(Rgb::BLACK, |sum, lamp| sum + values[lamp].map(|f| f.max(0.0)) * samples.factors[lamp])
}

/// Where the display curve is a power: neither clipped nor straight.
fn toe(radiance: f32) -> f32 {
    radiance.clamp(DISPLAY_TOE, 1.0)
}

/// Slope of the display curve; a clipped pixel keeps a little, or it could never come back.
fn display_slope(radiance: f32, displayed: f32) -> f32 {
    if radiance < DISPLAY_TOE {
        DISPLAY_TOE.powf(DISPLAY - 1.0)
    } else if radiance <= 1.0 {
        DISPLAY * displayed / radiance
    } else {
        DISPLAY / radiance
    }
}
