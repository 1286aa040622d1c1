//! Mixes of reflectance values: no representation, as costly to evaluate as all ends together.

use std::cell::Cell;
use std::sync::Arc;

use super::{Interpolation, Path, PathError, Weights, at_least_two};
use crate::brdf::Prepared;
use crate::nbrdf::objective::DARKEST;
use crate::{Brdf, Directions, Material, Rgb};

/// In which scale values are mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mix {
    /// Σ w f: two materials side by side, seen from far away.
    Linear,
    /// exp Σ w ln(f + 10⁻³) − 10⁻³: ratios count, dark materials too.
    Log,
    /// exp Σ w ln(f + 1) − 1: the networks' own output scale.
    Log1p,
}

impl Interpolation for Mix {
    fn name(&self) -> &'static str {
        match self {
            Self::Linear => "linear_mix",
            Self::Log => "log_mix",
            Self::Log1p => "log1p_mix",
        }
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        at_least_two(ends)?;
        Ok(Box::new(MixPath { mix: *self, ends: ends.iter().map(|end| Arc::clone(&end.brdf)).collect() }))
    }
}

struct MixPath {
    mix: Mix,
    ends: Vec<Arc<dyn Brdf>>,
}

impl Path for MixPath {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        let weights = weights.for_ends(self.ends.len())?;
        let parts = weights.iter().copied().zip(self.ends.iter().cloned()).filter(|(weight, _)| *weight != 0.0);
        Ok(Box::new(Mixed { mix: self.mix, parts: parts.collect() }))
    }
}

/// A mix as a reflectance.
pub struct Mixed {
    mix: Mix,
    parts: Vec<(f32, Arc<dyn Brdf>)>,
}

impl Mixed {
    /// Mixes `parts` of (weight, reflectance).
    pub fn new(mix: Mix, parts: Vec<(f32, Arc<dyn Brdf>)>) -> Self {
        Self { mix, parts }
    }
}

thread_local! {
    /// Each thread's values of one part; a mix of mixes finds none and makes its own.
    static PART: Cell<Vec<Rgb>> = const { Cell::new(Vec::new()) };
}

impl Mixed {
    /// Mixes what `eval` makes of every part, unclamped.
    fn mix(&self, at: &[Directions], out: &mut [Rgb], eval: impl Fn(&dyn Brdf, &mut [Rgb])) {
        let floor = match self.mix {
            Mix::Linear => 0.0,
            Mix::Log => DARKEST,
            Mix::Log1p => 1.0,
        };
        let mut part = PART.take();
        part.resize(at.len(), Rgb::BLACK);
        out.fill(Rgb::BLACK);
        for (weight, brdf) in &self.parts {
            eval(brdf.as_ref(), &mut part);
            for (out, f) in out.iter_mut().zip(&part) {
                *out += match self.mix {
                    Mix::Linear => *f * *weight,
                    Mix::Log | Mix::Log1p => f.map(|f| weight * (f + floor).ln()),
                };
            }
        }
        PART.set(part);
        if self.mix != Mix::Linear {
            for (out, at) in out.iter_mut().zip(at) {
                *out = if at.is_above() { out.map(|y| y.min(80.0).exp() - floor) } else { Rgb::BLACK };
            }
        }
    }
}

impl Brdf for Mixed {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_into(&[at], &mut out);
        out[0]
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.eval_signed_into(at, out);
        out.iter_mut().for_each(|f| *f = f.map(|f| f.max(0.0)));
    }

    fn eval_prepared(&self, at: &Prepared, out: &mut [Rgb]) {
        self.mix(at.directions(), out, |brdf, part| brdf.eval_prepared(at, part));
        out.iter_mut().for_each(|f| *f = f.map(|f| f.max(0.0)));
    }

    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.mix(at, out, |brdf, part| brdf.eval_into(at, part));
    }
}
