//! Formulas with parameters: a code is the parameters that fit a material best.
//!
//! The way materials were stored before tables and networks (A. Ngan, F. Durand, W. Matusik, *Experimental Analysis of
//! BRDF Models*, 2005, doi 10.2312/EGWR/EGSR05/117-126). Differs: the loss is that of the networks they stand beside,
//! mean |Δ ln(1 + f cos θ_i)| (A. Sztrajman et al., *Neural BRDF Representation and Importance Sampling*, 2021, section 3.1),
//! so that neither side is judged by what the other was fitted for; and codes are unconstrained numbers, logarithms and
//! logits of the parameters, so that any finite code is a reflectance.

mod abc;
mod fit;
mod lambert;
mod microfacet;
pub(crate) mod number;
mod sgd;
pub(crate) mod target;
mod ward;

use std::marker::PhantomData;

pub use abc::AbcLobe;
pub use lambert::LambertAlone;
pub use microfacet::{BlinnPhongLobe, GgxLobe};
pub use sgd::SgdLobes;
pub use target::Target;
pub use ward::WardLobe;

use target::Places;

use super::{Code, DecodeError, EncodeError, Representation};
use crate::sample_list::SampleList;
use crate::{Brdf, Material};

/// Which parameters the numbers of codes stand for: another meaning, another version.
const CHECKPOINT: &str = "formula-1";

/// Samples of a list that a formula is fitted to, at most.
const MOST_SAMPLES: usize = 1 << 14;

/// A formula, what the numbers of its codes mean, and where fits begin.
pub trait Parametric: Send + Sync + 'static {
    /// Name in the catalog and in codes.
    const NAME: &'static str;
    /// Numbers in a code.
    const DIM: usize;

    /// The reflectance of [`DIM`](Self::DIM) numbers; finite and not negative for any finite ones.
    ///
    /// # Panics
    /// If there are fewer (a bug of the caller).
    fn reflectance(numbers: &[f32]) -> Box<dyn Brdf>;

    /// The numbers that fit best; the same for the same target.
    fn fit(target: &Target) -> Vec<f32>;
}

/// A formula as a representation: encoding fits it, decoding writes it out. Nothing is learned from other materials.
pub struct Analytic<P>(PhantomData<fn() -> P>);

impl<P> Analytic<P> {
    /// The formula.
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<P: Parametric> Analytic<P> {
    /// The formula fitted to samples that were measured, each of which counts as much; none where there is none. Of very
    /// many samples every second, third, ... is taken: a few parameters need no more.
    pub fn fit_list(list: &SampleList) -> Option<Box<dyn Brdf>> {
        if list.is_empty() {
            return None;
        }
        let step = list.len().div_ceil(MOST_SAMPLES);
        let at: Vec<_> = list.at.iter().step_by(step).copied().collect();
        let values: Vec<_> = list.values.iter().step_by(step).copied().collect();
        let places = Places::new(at, vec![1.0; values.len()]);
        Some(P::reflectance(&P::fit(&Target::measured(&places, values))))
    }
}

impl<P> Default for Analytic<P> {
    fn default() -> Self {
        Self::new()
    }
}

impl<P: Parametric> Representation for Analytic<P> {
    fn name(&self) -> &'static str {
        P::NAME
    }

    fn dim(&self) -> usize {
        P::DIM
    }

    fn checkpoint(&self) -> &str {
        CHECKPOINT
    }

    fn shared_bytes(&self) -> usize {
        0
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let Some(seen) = Target::of(target.brdf.as_ref()) else {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        };
        Ok(self.code(P::fit(&seen)))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        Ok(P::reflectance(code.checked(P::NAME, CHECKPOINT, P::DIM)?))
    }
}

#[cfg(test)]
mod tests;
