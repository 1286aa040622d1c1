//! Measured materials of the RGL database: `.bsdf` tensor files with RGB data, read and written.
//!
//! J. Dupuy, W. Jakob, *An Adaptive Parameterization for Efficient Material Acquisition and Rendering* (2018), section 4:
//! half vectors are warped by the material's own distribution of visible normals, so that few samples fall where much
//! happens. Stored values are f_r · cos θ of the light; the eye is the first direction. Isotropic files hold one φ.

mod density;
mod fields;
mod grid;
mod tabulate;
mod write;

use std::f32::consts::{PI, TAU};
use std::io;
use std::path::Path;

use crate::{Brdf, Directions, Rgb, Vec3, bounded};
use fields::{Fields, mismatch};
use grid::{Grid, Warp};

pub use fields::FieldError;
pub use tabulate::{Resolution, Tabulated, Tabulation, tabulated_within};

/// Largest file that is read \[bytes\]; published ones with RGB data stay below 60 MB.
const MAX_FILE: u64 = 256 << 20;
/// Larger numbers are damage, and no reflectance is larger; sums of these are finite.
const LARGEST: f32 = 1e30;
/// How far azimuths may be from those of a whole circle \[rad\].
const WHOLE: f32 = 1e-3;
/// Cosines below are taken as this: f_r at the horizon has no meaning.
const SMALLEST_COSINE: f32 = 1e-4;

/// A measured material.
pub struct RglTable {
    is_isotropic: bool,
    /// Whether values are relative to the distribution of normals.
    has_jacobian: bool,
    /// Distribution of normals over (θ, φ) of the half vector.
    normals: Grid,
    /// Projected area over (θ, φ) of the eye.
    area: Grid,
    /// Distribution of visible normals for each eye.
    visible: Warp,
    /// Values for each eye and channel.
    values: Grid,
}

/// Why a file is no RGL material.
#[derive(Debug, thiserror::Error)]
pub enum RglError {
    /// The file system says no.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// More bytes than any material needs.
    #[error("expected {MAX_FILE} bytes at most, found more: is it the right file?")]
    TooLarge,
    /// Not the tensors of a material.
    #[error(transparent)]
    Tensors(#[from] FieldError),
}

impl RglTable {
    /// Reads a file.
    ///
    /// # Errors
    /// [`RglError`]: not there, too large, or not a material with RGB data.
    pub fn load(path: &Path) -> Result<Self, RglError> {
        let bytes = bounded::read(path, MAX_FILE)?.ok_or(RglError::TooLarge)?;
        Self::parse(&bytes)
    }

    /// From the bytes of a file.
    ///
    /// # Errors
    /// [`RglError::Tensors`].
    pub fn parse(bytes: &[u8]) -> Result<Self, RglError> {
        let file = Fields::parse(bytes)?;
        let places = |name: &str| -> Result<Vec<f32>, FieldError> {
            let tensor = file.floats(name)?;
            let rises = tensor.values.windows(2).all(|pair| pair[0] < pair[1]);
            match tensor.shape.len() == 1 && !tensor.values.is_empty() && rises {
                true => Ok(tensor.values),
                false => Err(mismatch(name, "one row of rising numbers", format!("shape {:?}", tensor.shape))),
            }
        };
        let (phi, theta) = (places("phi_i")?, places("theta_i")?);
        // Files of symmetric materials may hold a part of the circle: they would need to be unfolded.
        let turn = phi.last().zip(phi.first()).map_or(0.0, |(last, first)| last - first);
        let first = phi.first().copied().unwrap_or_default();
        if phi.len() > 2 && ((first + PI).abs() > WHOLE || (turn - TAU).abs() > WHOLE) {
            let found = format!("{first} to {}", first + turn);
            return Err(mismatch("phi_i", "azimuths from -pi to pi", found).into());
        }
        let grid = |name: &str, parameters: Vec<Vec<f32>>| -> Result<Grid, FieldError> {
            let tensor = file.floats(name)?;
            let leading: Vec<usize> = parameters.iter().map(Vec::len).collect();
            let is_as_expected = tensor.shape.len() == leading.len() + 2
                && tensor.shape.starts_with(&leading)
                && tensor.shape[leading.len()..].iter().all(|&size| size >= 2);
            if !is_as_expected {
                let expected = format!("shape {leading:?} and two sizes of at least 2");
                return Err(mismatch(name, &expected, format!("{:?}", tensor.shape)));
            }
            // Measured values may fall below zero by noise; densities and areas may not.
            if name != "rgb"
                && let Some(index) = tensor.values.iter().position(|&value| value < 0.0)
            {
                return Err(mismatch(name, "no negative number", format!("one as number {index}")));
            }
            let [rows, columns] = [tensor.shape[leading.len()], tensor.shape[leading.len() + 1]];
            Ok(Grid::new(columns, rows, parameters, tensor.values))
        };
        let channels = vec![0.0, 1.0, 2.0];
        Ok(Self {
            is_isotropic: phi.len() <= 2,
            has_jacobian: file.bytes("jacobian")?.first().is_some_and(|&flag| flag != 0),
            normals: grid("ndf", Vec::new())?,
            area: grid("sigma", Vec::new())?,
            visible: Warp::new(grid("vndf", vec![phi.clone(), theta.clone()])?),
            values: grid("rgb", vec![phi, theta, channels])?,
        })
    }

    /// Whether reflectance depends on the azimuth of eye and light together.
    pub const fn is_isotropic(&self) -> bool {
        self.is_isotropic
    }
}

impl Brdf for RglTable {
    fn eval(&self, at: Directions) -> Rgb {
        let Directions { light, view } = at;
        if !at.is_above() {
            return Rgb::BLACK;
        }
        let half = (light + view).normalize_or(Vec3::Z);
        let [(theta_view, phi_view), (theta_half, phi_half)] = [view, half].map(angles);
        let phi = if self.is_isotropic { phi_half - phi_view } else { phi_half };
        let at_half = [along(theta_half), around(phi).rem_euclid(1.0)];
        let parameters = [phi_view, theta_view];
        let warped = self.visible.invert(&self.visible.slices(&parameters), at_half);
        let value = |channel: u8| {
            let slices = self.values.slices(&[phi_view, theta_view, f32::from(channel)]);
            self.values.eval(&slices, warped).max(0.0)
        };
        let jacobian = if self.has_jacobian {
            let nothing = self.normals.slices(&[]);
            let area = self.area.eval(&nothing, [along(theta_view), around(phi_view)]);
            self.normals.eval(&nothing, at_half) / (4.0 * area.max(f32::MIN_POSITIVE))
        } else {
            1.0
        };
        // Where next to no area is seen, a damaged table divides by next to nothing.
        let scale = (jacobian / light.z.max(SMALLEST_COSINE)).min(LARGEST);
        Rgb([0, 1, 2].map(|channel| (value(channel) * scale).min(LARGEST)))
    }
}

/// Polar angle and azimuth; the angle to the pole by the chord, which keeps its digits near the pole.
fn angles(v: Vec3) -> (f32, f32) {
    let chord = (v.x * v.x + v.y * v.y + (v.z - 1.0) * (v.z - 1.0)).sqrt();
    (2.0 * (0.5 * chord).min(1.0).asin(), v.y.atan2(v.x))
}

/// Polar angle as a place in a table, 0..1: crowded towards the pole.
fn along(theta: f32) -> f32 {
    (theta * (2.0 / PI)).sqrt()
}

/// Azimuth as a place in a table, 0..1.
fn around(phi: f32) -> f32 {
    (phi + PI) / TAU
}
