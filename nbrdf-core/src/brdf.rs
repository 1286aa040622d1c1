//! What a material is to everything else: a function from a pair of directions to a reflectance.

pub mod abc;
pub(crate) mod factored;
pub mod free_fresnel;
pub mod ggx;
pub mod lambert;
pub mod lobed;
pub mod microfacet;
pub(crate) mod pairs;
mod places;
mod prepared;
pub mod sgd;
pub mod standard_table;
pub mod table;
mod vectors;
pub mod ward;

pub use prepared::{Azimuth, Prepared};

use std::any::Any;

use crate::{Directions, Rgb};

/// Reflectance f_r \[1/sr\], linear RGB, never the cosine. Zero below either horizon.
pub trait Brdf: Any + Send + Sync {
    /// f_r for one pair of directions; finite and not negative for finite unit vectors.
    fn eval(&self, at: Directions) -> Rgb;

    /// f_r for many pairs: the seam for fast models.
    ///
    /// # Panics
    /// If `at` and `out` differ in length (a bug of the caller).
    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        assert_eq!(at.len(), out.len(), "one output per pair of directions");
        for (&at, out) in at.iter().zip(out) {
            *out = self.eval(at);
        }
    }

    /// Like [`eval_into`](Self::eval_into), from pairs that are asked again and again of changing materials: models
    /// that read half and difference vectors find them ready.
    ///
    /// # Panics
    /// If `at` and `out` differ in length (a bug of the caller).
    fn eval_prepared(&self, at: &Prepared, out: &mut [Rgb]) {
        self.eval_into(at.directions(), out);
    }

    /// Like [`eval_into`](Self::eval_into), but before the model's own clamp at zero:
    /// how far the stored function is from a reflectance (metric `negative_share`).
    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.eval_into(at, out);
    }
}
