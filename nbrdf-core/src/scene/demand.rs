//! What a picture asks of one object's material.

use std::borrow::Cow;

use rayon::prelude::*;

use crate::{Brdf, Directions, Rgb};

/// Pixels that one task shades.
const PIXELS_AT_ONCE: usize = 64;

/// Every pair of directions that an object's pixels need, and what its reflectance counts for there: the object's
/// radiance in a pixel is Σ weight f_r.
#[derive(Clone, Debug, Default)]
pub struct Demand {
    /// Pixels in which the object is seen, row by row, and where their pairs end.
    pixels: Vec<(usize, usize)>,
    at: Vec<Directions>,
    /// L cos θ_i / density, times the share of the pixel's rays.
    weights: Vec<Rgb>,
}

impl Demand {
    /// Adds the pairs of one ray; rays of one pixel follow each other.
    pub(super) fn push(&mut self, pixel: usize, at: &[Directions], weights: &[Rgb]) {
        self.at.extend_from_slice(at);
        self.weights.extend_from_slice(weights);
        let end = self.at.len();
        match self.pixels.last_mut() {
            Some((last, last_end)) if *last == pixel => *last_end = end,
            _ => self.pixels.push((pixel, end)),
        }
    }

    /// Pixels in which the object is seen, by their place in the picture.
    pub fn pixels(&self) -> impl ExactSizeIterator<Item = usize> {
        self.pixels.iter().map(|&(pixel, _)| pixel)
    }

    /// Evaluations of the material that the picture needs.
    pub const fn evaluations(&self) -> usize {
        self.at.len()
    }

    /// Runs of `length` pairs that follow each other in the picture, `count` of them at most, spread over the object; the
    /// same pairs again and again where there are fewer.
    pub fn batches(&self, length: usize, count: usize) -> Vec<Cow<'_, [Directions]>> {
        if self.at.len() < length {
            let filled: Vec<Directions> = self.at.iter().copied().cycle().take(length).collect();
            return vec![Cow::Owned(filled)];
        }
        // The last one may be short.
        let whole = self.at.chunks_exact(length.max(1));
        let step = whole.len().div_ceil(count.max(1)).max(1);
        whole.step_by(step).map(Cow::Borrowed).collect()
    }

    /// The object's radiance in each of its [`pixels`](Self::pixels), if it were of this material. In parallel; the result
    /// does not depend on the number of threads.
    pub fn radiance(&self, brdf: &dyn Brdf) -> Vec<Rgb> {
        let mut radiance = vec![Rgb::BLACK; self.pixels.len()];
        let chunks = radiance.par_chunks_mut(PIXELS_AT_ONCE).enumerate();
        chunks.for_each_init(Vec::new, |values, (chunk, out)| {
            let first = chunk * PIXELS_AT_ONCE;
            let pixels = &self.pixels[first..first + out.len()];
            let begin = if first == 0 { 0 } else { self.pixels[first - 1].1 };
            let end = pixels.last().map_or(begin, |&(_, end)| end);
            values.resize(end - begin, Rgb::BLACK);
            brdf.eval_into(&self.at[begin..end], values);
            let mut from = begin;
            for (&(_, end), out) in pixels.iter().zip(out) {
                let terms = values[from - begin..end - begin].iter().zip(&self.weights[from..end]);
                let mut sum = [0.0_f64; 3];
                for (value, weight) in terms {
                    for channel in 0..3 {
                        sum[channel] += f64::from(value[channel]) * f64::from(weight[channel]);
                    }
                }
                *out = Rgb(sum.map(|sum| sum.min(f64::from(f32::MAX)) as f32));
                from = end;
            }
        });
        radiance
    }

    /// About `count` of the pixels with all of their pairs, evenly over the object; which ones are told beside.
    pub fn some(&self, count: usize) -> (Self, Vec<usize>) {
        let step = self.pixels.len().div_ceil(count.max(1)).max(1);
        let chosen: Vec<usize> = (0..self.pixels.len()).skip(step / 2).step_by(step).collect();
        let mut some = Self::default();
        for &index in &chosen {
            let begin = if index == 0 { 0 } else { self.pixels[index - 1].1 };
            let (pixel, end) = self.pixels[index];
            some.push(pixel, &self.at[begin..end], &self.weights[begin..end]);
        }
        (some, chosen)
    }
}
