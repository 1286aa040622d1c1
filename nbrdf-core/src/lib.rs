//! Neural BRDFs and everything around them that needs neither autodiff, nor a window, nor a command line.
//!
//! The whole flow: named materials, a walk between two of them, spheres, and a figure.
//!
//! ```
//! use nbrdf_core::library::builtin;
//! use nbrdf_core::metric::{LogError, Metric, image_errors};
//! use nbrdf_core::path::mix::Mix;
//! use nbrdf_core::path::weight_path::WeightInterpolation;
//! use nbrdf_core::render::Sphere;
//! use nbrdf_core::{Interpolation, Path, Weights};
//!
//! // A material is a name, a reflectance and, here, a network of 675 weights.
//! let library = builtin::shared();
//! let ends = [library.get("gold-paint")?.material(), library.get("blue-acrylic")?.material()];
//!
//! // An interpolation prepares a path once; the path then gives a reflectance at any weights.
//! let own_networks = WeightInterpolation::new("shared_start", Box::new(|_| None));
//! let middle = own_networks.between(&ends)?.at(&Weights::two(0.5))?;
//! let mix = Mix::Linear.between(&ends)?.at(&Weights::two(0.5))?;
//!
//! // Reflectances are rendered and compared.
//! let sphere = Sphere::studio();
//! let errors = image_errors(&sphere.render(&*mix), &sphere.render(&*middle), sphere.covered());
//! assert!(errors.psnr > 20.0 && LogError.distance(&*mix, &*middle) < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Where to begin: [`Brdf`] is a reflectance, [`Representation`] a material as numbers and back, [`Interpolation`] a walk,
//! [`metric::Metric`] a distance, [`Sampler`] a way to draw lights. Modules that these pages do not show are public for the
//! other crates of the workspace alone, and change without notice.

#[doc(hidden)]
pub mod adam;
#[doc(hidden)]
pub mod atomic;
pub mod axis;
#[doc(hidden)]
pub mod bounded;
pub mod brdf;
pub mod class;
mod color;
pub mod cost;
pub mod data;
pub mod database;
#[doc(hidden)]
pub mod dense;
pub mod direction;
#[doc(hidden)]
pub mod extensions;
#[doc(hidden)]
pub mod hash;
pub mod image;
mod least_squares;
pub mod library;
#[doc(hidden)]
pub mod linear_system;
mod material;
pub mod measured;
pub mod merl;
pub mod metric;
pub mod nbrdf;
#[doc(hidden)]
pub mod near;
pub mod parametric;
pub mod path;
pub mod plan;
#[doc(hidden)]
pub mod published_fits;
pub mod quality;
#[doc(hidden)]
pub mod rank;
pub mod render;
pub mod representation;
pub mod rgl;
pub mod sample_list;
pub mod sampler;
pub mod sampling;
pub mod scene;
pub mod shader;
pub mod simd;
pub mod spectrum;
pub mod split;
#[doc(hidden)]
pub mod stress;
#[doc(hidden)]
pub mod tensor_file;
mod warning;

pub use brdf::Brdf;
pub use color::Rgb;
pub use database::Database;
pub use direction::{Directions, HalfDiff, Rusinkiewicz};
pub use glam::Vec3;
pub use image::Image;
pub use library::Library;
pub use material::Material;
pub use nbrdf::Nbrdf;
pub use path::{Interpolation, Path, Weights};
pub use representation::{Code, Representation};
pub use sampler::Sampler;
pub use split::Split;
pub use warning::Warning;
