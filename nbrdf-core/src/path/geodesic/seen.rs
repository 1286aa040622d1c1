//! A code as it is seen: a small sphere in ITP, its mean colour, and how both move with the numbers of the code.

use faer::Mat;

use crate::brdf::Prepared;
use crate::metric::{chromaticity_and_slopes, itp_and_slopes};
use crate::nbrdf::tangent::{Tangents, tangents};
use crate::render::{Light, Lit};
use crate::representation::DecodeError;
use crate::{Representation, Rgb};

/// Side of the sphere \[pixels\].
const SIZE: usize = 32;

/// The geometry of the pictures.
pub(super) struct Canvas {
    at: Prepared,
    lit: Lit,
}

impl Canvas {
    /// Under light `studio`.
    pub fn new() -> Self {
        let (at, lit) = Lit::new(SIZE, &Light::studio());
        Self { at, lit }
    }

    /// Linear pixels of reflectances at every pair.
    fn pixels(&self, values: &[Rgb]) -> Vec<[f64; 3]> {
        let mut terms = values.iter().zip(&self.lit.weights);
        let pixel = |&lamps: &usize| {
            terms
                .by_ref()
                .take(lamps)
                .fold([0.0; 3], |sum, (f, weight)| [0, 1, 2].map(|c| sum[c] + f64::from(f[c]) * f64::from(weight[c])))
        };
        self.lit.lamps.iter().map(pixel).collect()
    }
}

/// A code's picture and its derivatives.
pub(super) struct Seen {
    /// I, T, P of every pixel, scaled so that the square of a difference is a mean over pixels.
    picture: Vec<f64>,
    /// ∂picture/∂number, one column per number.
    by_number: Mat<f64>,
    /// Mean colour in u′v′.
    pub colour: [f64; 2],
    colour_by_number: Vec<[f64; 2]>,
}

impl Seen {
    /// None where the code does not decode to a network smoothly.
    pub fn of(representation: &dyn Representation, canvas: &Canvas, code: &[f32]) -> Result<Option<Self>, DecodeError> {
        let Some(linearized) = representation.linearize(code)? else { return Ok(None) };
        let changes: Vec<&[f32]> = linearized.rows().collect();
        let Tangents { values, derivatives } = tangents(linearized.hidden, &linearized.weights, &changes, &canvas.at);
        let clamped: Vec<Rgb> = values.iter().map(|f| f.map(|f| f.max(0.0))).collect();
        let pixels = canvas.pixels(&clamped);
        let scale = 1.0 / (pixels.len() as f64).sqrt();
        let seen: Vec<_> = pixels.iter().map(|pixel| itp_and_slopes(Rgb(pixel.map(|v| v as f32)))).collect();
        let picture = seen.iter().flat_map(|(itp, _)| itp.map(|v| scale * v)).collect();
        let clip = |pixel: &[f64; 3]| pixel.map(|v| v.clamp(0.0, 1.0));
        let (colour, by_mean) = chromaticity_and_slopes(mean(pixels.iter().map(clip)));
        let mut by_number = Mat::zeros(3 * pixels.len(), derivatives.len());
        let mut colour_by_number = Vec::with_capacity(derivatives.len());
        for (number, moved) in derivatives.iter().enumerate() {
            // What is clamped does not move.
            let moved: Vec<Rgb> =
                moved.iter().zip(&values).map(|(d, f)| d.zip(*f, |d, f| if f > 0.0 { d } else { 0.0 })).collect();
            let moved = canvas.pixels(&moved);
            for (pixel, ((_, slopes), moved)) in seen.iter().zip(&moved).enumerate() {
                for axis in 0..3 {
                    let change: f64 = (0..3).map(|channel| slopes[channel][axis] * moved[channel]).sum();
                    by_number[(3 * pixel + axis, number)] = scale * change;
                }
            }
            let inside = |(pixel, moved): (&[f64; 3], &[f64; 3])| {
                [0, 1, 2].map(|c| if (0.0..=1.0).contains(&pixel[c]) { moved[c] } else { 0.0 })
            };
            let mean = mean(pixels.iter().zip(&moved).map(inside));
            let along = |axis: usize| (0..3).map(|channel| by_mean[channel][axis] * mean[channel]).sum();
            colour_by_number.push([along(0), along(1)]);
        }
        Ok(Some(Self { picture, by_number, colour, colour_by_number }))
    }

    /// Mean over pixels of the squared difference in ITP.
    pub fn square_distance(&self, other: &Self) -> f64 {
        self.picture.iter().zip(&other.picture).map(|(a, b)| (a - b) * (a - b)).sum()
    }

    /// Σ (∂picture/∂number)².
    pub fn squares(&self, number: usize) -> f64 {
        self.by_number.col(number).iter().map(|v| v * v).sum()
    }

    /// How the mean colour moves with a number.
    pub fn colour_by(&self, number: usize) -> [f64; 2] {
        self.colour_by_number[number]
    }

    /// Jᵀ J of two pictures' derivatives.
    pub fn product(&self, other: &Self) -> Mat<f64> {
        self.by_number.transpose() * &other.by_number
    }

    /// Jᵀ (2 P − P before − P after): half the slope of the squared distances to both neighbours.
    pub fn pull(&self, before: &Self, after: &Self) -> Vec<f64> {
        let neighbours = before.picture.iter().zip(&after.picture);
        let residual: Vec<f64> =
            self.picture.iter().zip(neighbours).map(|(own, (before, after))| 2.0 * own - before - after).collect();
        let dot = |i: usize| self.by_number.col(i).iter().zip(&residual).map(|(d, r)| d * r).sum();
        (0..self.by_number.ncols()).map(dot).collect()
    }
}

fn mean(values: impl ExactSizeIterator<Item = [f64; 3]>) -> [f64; 3] {
    let count = values.len().max(1) as f64;
    values.fold([0.0; 3], |sum, v| [0, 1, 2].map(|c| sum[c] + v[c])).map(|sum| sum / count)
}
