//! Measured samples in a list: pairs of directions in any order, and what was reflected.

mod csv;
mod goniometer;

use std::f32::consts::TAU;
use std::io;
use std::path::Path;

use crate::{Directions, Rgb, bounded};

/// Largest file that is read \[bytes\].
const MAX_FILE: u64 = 256 << 20;

/// Larger numbers are damage; these are finite in single precision.
const LARGEST: f64 = 1e30;
/// Half vectors closer to the normal \[rad\] say little of the azimuth.
const OFF_THE_NORMAL: f32 = 0.1;

/// Samples of a reflectance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SampleList {
    /// Light and view, above the surface.
    pub at: Vec<Directions>,
    /// f_r \[1/sr\], linear RGB, not negative.
    pub values: Vec<Rgb>,
    /// Samples left out: at or below the horizon.
    pub below: usize,
}

/// Why a file is no list of samples.
#[derive(Debug, thiserror::Error)]
pub enum SampleListError {
    /// The file system says no.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// More bytes than are read.
    #[error("expected {MAX_FILE} bytes at most, found more: split the file")]
    TooLarge,
    /// Something else than a sample.
    #[error("line {line}: expected {expected}, found {found}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
    },
    /// No samples above the horizon.
    #[error("expected samples with light and view above the surface, found none")]
    Empty,
}

impl SampleList {
    /// Reads a goniometer's text (`.brdf`) or a table of values (`.csv`), told apart by the name.
    ///
    /// # Errors
    /// [`SampleListError`].
    pub fn load(path: &Path) -> Result<Self, SampleListError> {
        let bytes = bounded::read(path, MAX_FILE)?.ok_or(SampleListError::TooLarge)?;
        let text = String::from_utf8_lossy(&bytes);
        let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        if is_csv { Self::of_csv(&text) } else { Self::of_goniometer(&text) }
    }

    /// From a goniometer's text: `#` comments, the number of wavelengths, the wavelengths \[nm\], then lines of θ_i φ_i θ_s φ_s
    /// \[rad\] and a reflectance \[1/sr\] for each wavelength. Colours: CIE 1931 under D65.
    ///
    /// # Errors
    /// [`SampleListError::Line`] or [`SampleListError::Empty`].
    pub fn of_goniometer(text: &str) -> Result<Self, SampleListError> {
        goniometer::parse(text)
    }

    /// From comma-separated values: a heading `light_x,light_y,light_z,view_x,view_y,view_z,r,g,b`, then unit vectors and
    /// f_r \[1/sr\].
    ///
    /// # Errors
    /// [`SampleListError::Line`] or [`SampleListError::Empty`].
    pub fn of_csv(text: &str) -> Result<Self, SampleListError> {
        csv::parse(text)
    }

    /// Samples.
    pub fn len(&self) -> usize {
        self.at.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.at.is_empty()
    }

    /// Every `n`-th sample, from the `first` on, and all others: to fit on the ones and to judge by the others.
    pub fn split(&self, n: usize, first: usize) -> [Self; 2] {
        let mut parts = [Self::default(), Self::default()];
        for (i, (&at, &value)) in self.at.iter().zip(&self.values).enumerate() {
            let part = &mut parts[usize::from(i % n != first)];
            part.at.push(at);
            part.values.push(value);
        }
        parts[1].below = self.below;
        parts
    }

    /// Largest range of azimuths of the half vector \[rad\] without a sample, of half vectors that are off the normal; 2π
    /// where all are at it.
    pub fn largest_gap(&self) -> f32 {
        let off = self.at.iter().map(|at| at.rusinkiewicz()).filter(|angles| angles.theta_half > OFF_THE_NORMAL);
        let mut azimuths: Vec<f32> = off.map(|angles| angles.phi_half).collect();
        azimuths.sort_by(f32::total_cmp);
        let (Some(first), Some(last)) = (azimuths.first(), azimuths.last()) else { return TAU };
        let around = TAU - (last - first);
        azimuths.windows(2).map(|pair| pair[1] - pair[0]).fold(around, f32::max)
    }

    fn push(&mut self, at: Directions, value: Rgb) {
        if at.is_above() {
            self.at.push(at);
            self.values.push(value.map(|f| f.max(0.0)));
        } else {
            self.below += 1;
        }
    }

    fn not_empty(self) -> Result<Self, SampleListError> {
        if self.is_empty() { Err(SampleListError::Empty) } else { Ok(self) }
    }
}

/// The numbers of a line.
fn numbers(line: usize, fields: &[&str]) -> Result<Vec<f64>, SampleListError> {
    let number = |field: &&str| match field.trim().parse::<f64>() {
        Ok(value) if value.abs() <= LARGEST => Ok(value),
        _ => Err(problem(
            line,
            "a finite number below 1e30",
            format!("'{}'", field.chars().take(40).collect::<String>()),
        )),
    };
    fields.iter().map(number).collect()
}

fn problem(line: usize, expected: &str, found: String) -> SampleListError {
    SampleListError::Line { line, expected: expected.to_owned(), found }
}
