//! MERL `.binary` tables: read, written, looked up.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 3; layout, scales and the meaning of negative
//! numbers as in the reader that comes with the database (BRDFRead.cpp): little-endian i32 90, 90, 180, then a plane of f64
//! for red, green and blue, index φ_diff + 180 (θ_diff + 90 θ_half). Negative numbers were not measured.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use crate::brdf::table::{CELLS, Lookup, Table, middles};
use crate::sampling::evaluate;
use crate::{Brdf, Rgb, atomic};

/// Numbers of one plane.
const PLANE: usize = CELLS[0] * CELLS[1] * CELLS[2];
/// Bytes before the first plane.
const HEADER: usize = 3 * size_of::<i32>();
/// Bytes of a file.
pub const FILE_BYTES: usize = HEADER + 3 * PLANE * size_of::<f64>();
/// f_r \[1/sr\] of a stored 1 in red, green, blue.
pub const SCALES: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];
/// Larger numbers are damage; these are finite in single precision.
const LARGEST: f64 = 1e30;
/// Stored where nothing was measured.
const INVALID: f64 = -1.0;

/// A table as it is stored: what is read is written again to the byte.
#[derive(Clone, Debug, PartialEq)]
pub struct Merl {
    /// Planes of red, green, blue.
    stored: Vec<f64>,
}

/// Why bytes are no MERL table.
#[derive(Debug, thiserror::Error)]
pub enum MerlError {
    /// The file system says no.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// A file of another length.
    #[error("expected {FILE_BYTES} bytes of a MERL table, found {found}: is it the right file, and whole?")]
    Length {
        /// Bytes found.
        found: u64,
    },
    /// Cells along the angles other than 90, 90, 180.
    #[error("expected 90 x 90 x 180 cells in bytes 0..12, found {} x {} x {}{}", found[0], found[1], found[2], advice(*found))]
    Cells {
        /// Cells found.
        found: [i32; 3],
    },
    /// A number that is none.
    #[error("expected a number below {LARGEST:e} at byte {byte}, found {value}: the table is damaged, fetch it again")]
    NotFinite {
        /// Where in the file.
        byte: usize,
        /// The number.
        value: f64,
    },
    /// No cell was measured.
    #[error("expected measured cells, found only negative numbers, which mean that nothing was measured")]
    Empty,
}

fn advice(found: [i32; 3]) -> &'static str {
    match found {
        [90, 90, 360] => ": the whole circle of phi_diff; reciprocity makes its halves equal, keep the first 180",
        _ => "",
    }
}

impl Merl {
    /// Reads a file; its length is checked before anything is allocated.
    ///
    /// # Errors
    /// [`MerlError`]: not there, or not a table.
    pub fn load(path: &Path) -> Result<Self, MerlError> {
        let mut file = File::open(path)?;
        let found = file.metadata()?.len();
        if found != FILE_BYTES as u64 {
            // What the header says tells more than the length.
            let mut header = [0; HEADER];
            if file.read_exact(&mut header).is_ok() {
                check_cells(&header)?;
            }
            return Err(MerlError::Length { found });
        }
        let mut bytes = Vec::with_capacity(FILE_BYTES);
        file.take(FILE_BYTES as u64).read_to_end(&mut bytes)?;
        Self::parse(&bytes)
    }

    /// From the bytes of a file.
    ///
    /// # Errors
    /// [`MerlError`]: not a table.
    pub fn parse(bytes: &[u8]) -> Result<Self, MerlError> {
        if let Some(header) = bytes.first_chunk::<HEADER>() {
            check_cells(header)?;
        }
        if bytes.len() != FILE_BYTES {
            return Err(MerlError::Length { found: bytes.len() as u64 });
        }
        let (numbers, _) = bytes[HEADER..].as_chunks::<8>();
        let stored: Vec<f64> = numbers.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect();
        if let Some(index) = stored.iter().position(|value| value.is_nan() || value.abs() > LARGEST) {
            return Err(MerlError::NotFinite { byte: HEADER + 8 * index, value: stored[index] });
        }
        let merl = Self { stored };
        if (0..PLANE).all(|cell| merl.cell(cell).is_none()) {
            return Err(MerlError::Empty);
        }
        Ok(merl)
    }

    /// The bytes of a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let header = CELLS.map(|cells| (cells as i32).to_le_bytes());
        header.into_iter().flatten().chain(self.stored.iter().flat_map(|value| value.to_le_bytes())).collect()
    }

    /// Writes a file, whole or not at all.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        atomic::write(path, &self.to_bytes())
    }

    /// The table of a reflectance, at the middles of the cells; those below the horizon are not measured.
    pub fn tabulate(brdf: &dyn Brdf) -> Self {
        let at = middles();
        let values = evaluate(brdf, at);
        let plane = |channel: usize| {
            let stored = move |(at, f): (&crate::Directions, &Rgb)| match at.is_above() {
                true => f64::from(f[channel]) / SCALES[channel],
                false => INVALID,
            };
            at.iter().zip(&values).map(stored)
        };
        Self { stored: (0..3).flat_map(plane).collect() }
    }

    /// f_r \[1/sr\] of a cell; none where any channel was not measured.
    pub fn cell(&self, index: usize) -> Option<Rgb> {
        let stored = [0, 1, 2].map(|channel| self.stored[channel * PLANE + index]);
        let measured = stored.iter().all(|&value| value >= 0.0);
        measured.then(|| Rgb([0, 1, 2].map(|channel| (stored[channel] * SCALES[channel]) as f32)))
    }

    /// Ready to be looked up: cells that were not measured count only where nothing else is near.
    pub fn table(&self, lookup: Lookup) -> Table {
        Table::of_cells((0..PLANE).map(|cell| self.cell(cell)), lookup)
    }
}

fn check_cells(header: &[u8; HEADER]) -> Result<(), MerlError> {
    let (cells, _) = header.as_chunks::<4>();
    let found = [0, 1, 2].map(|i| i32::from_le_bytes(cells[i]));
    if found == CELLS.map(|cells| cells as i32) { Ok(()) } else { Err(MerlError::Cells { found }) }
}
