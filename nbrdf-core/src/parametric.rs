//! Measured materials as the few numbers of standard shading models, for tools that accept nothing else.
//!
//! A [`ShadingModel`] is evaluated as its specification says, its parameters stay within the ranges of the
//! specification, and [`fit`] finds them: [`GltfPbr`], [`OpenPbr`], [`Principled`]. Such a fit loses what the model has no
//! term for, so it never travels without its [`FitErrors`].
//!
//! ```
//! use nbrdf_core::library::builtin;
//! use nbrdf_core::parametric::{GltfPbr, fit};
//!
//! let paint = builtin::shared().get("gold-paint")?.material();
//! let fitted = fit::<GltfPbr>(paint.brdf.as_ref()).ok_or("not finite")?;
//! assert!(fitted.model.roughness < 1.0 && fitted.errors.studio_psnr > 20.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod albedo;
mod charlie;
mod eon;
mod errors;
mod file_error;
mod fit;
mod gltf;
mod lobe;
mod open_pbr;
mod parameter;
mod principled;
mod starts;
mod written;

pub use errors::FitErrors;
pub use file_error::FileError;
pub use fit::{Fitted, fit};
pub use gltf::GltfPbr;
pub use open_pbr::OpenPbr;
pub use parameter::{Parameter, Sequence};
pub use principled::Principled;

use crate::Brdf;

/// A reflectance with named parameters, as a specification defines it.
pub trait ShadingModel: Copy + Send + Sync + 'static {
    /// Name in reports.
    const NAME: &'static str;
    /// All parameters, in the order of [`values`](Self::values). The first five numbers are base colour, metalness and
    /// roughness.
    const PARAMETERS: &'static [Parameter];

    /// From all numbers in their order; what is out of range is evaluated as it is.
    fn from_values(values: &[f32]) -> Self;

    /// All numbers, parameter by parameter, three of a colour.
    fn values(&self) -> Vec<f32>;

    /// The reflectance.
    fn brdf(&self) -> Box<dyn Brdf>;
}

#[cfg(test)]
mod tests;
