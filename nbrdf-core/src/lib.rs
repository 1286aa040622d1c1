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

pub mod adam;
pub mod atomic;
pub mod axis;
pub mod bounded;
pub mod brdf;
pub mod class;
pub mod color;
pub mod cost;
pub mod data;
pub mod database;
pub mod dense;
pub mod direction;
pub mod hash;
pub mod image;
pub mod least_squares;
pub mod library;
pub mod linear_system;
pub mod material;
pub mod measured;
pub mod merl;
pub mod metric;
pub mod nbrdf;
pub mod path;
pub mod plan;
pub mod published_fits;
pub mod quality;
pub mod rank;
pub mod render;
pub mod representation;
pub mod rgl;
pub mod sample_list;
pub mod sampler;
pub mod sampling;
pub mod scene;
pub mod simd;
pub mod spectrum;
pub mod split;
pub mod stress;
pub mod tensor_file;
pub mod warning;

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
