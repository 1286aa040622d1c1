//! The published analytic fits of the 100 MERL materials: tables of parameters, one row per material.
//!
//! M. Bagher et al., *Accurate Fitting of Measured Reflectances using a Shifted Gamma Micro-facet Distribution* (2012),
//! supplement, and J. Löw et al., *BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces* (2012),
//! supplement, as comma-separated files (`published_fits/sgd_merl.csv`, `abc_merl.csv` in [`data::folder`](crate::data)).
//! Columns are found by name; others may stand beside them.

mod table;

use std::io;
use std::path::{Path, PathBuf};

use crate::Rgb;
use crate::brdf::abc::Abc;
use crate::brdf::sgd::{Sgd, Shadowing, ShiftedGamma};
use table::{Row, Table};

/// The SGD fits, by the names of the materials, in the order of the file.
///
/// # Errors
/// [`PublishedFitError`].
pub fn sgd(path: &Path) -> Result<Vec<(String, Sgd)>, PublishedFitError> {
    Table::load(path)?.rows(sgd_of_row)
}

/// The ABC fits, by the names of the materials, in the order of the file.
///
/// # Errors
/// [`PublishedFitError`].
pub fn abc(path: &Path) -> Result<Vec<(String, Abc)>, PublishedFitError> {
    Table::load(path)?.rows(abc_of_row)
}

fn sgd_of_row(row: &Row) -> Result<Sgd, PublishedFitError> {
    let of_channel = |channel: &str| {
        let number = |column: &str, least| row.number(&format!("{column}_{channel}"), least);
        let k = number("k", ABOVE_ZERO)? as f32;
        let c = number("c", ABOVE_ZERO)?;
        let (scale, norm) = (number("rhoS", 0.0)?, number("kap", 0.0)?);
        let (lambda, theta0) = (number("lambda", 0.0)? as f32, number("theta0", ANY)? as f32);
        Ok(ShiftedGamma {
            diffuse: number("rhoD", 0.0)? as f32,
            specular: (scale * norm).min(1e30) as f32,
            alpha: number("alpha", ABOVE_ZERO)? as f32,
            p: number("p", 0.0)? as f32,
            f0: number("f0", ANY)? as f32,
            f1: number("f1", ANY)? as f32,
            shadowing: Shadowing::new(lambda, c, k, theta0),
        })
    };
    Ok(Sgd { channels: [of_channel("r")?, of_channel("g")?, of_channel("b")?] })
}

fn abc_of_row(row: &Row) -> Result<Abc, PublishedFitError> {
    let rgb = |column: &str| {
        let of_channel = |channel: &str| Ok(row.number(&format!("{column}_{channel}"), 0.0)? as f32);
        Ok::<_, PublishedFitError>(Rgb([of_channel("r")?, of_channel("g")?, of_channel("b")?]))
    };
    Ok(Abc {
        diffuse: rgb("kD")?,
        a: rgb("A")?,
        b: row.number("B", 0.0)? as f32,
        c: row.number("C", 0.0)? as f32,
        ior: row.number("ior", 1.0)? as f32,
    })
}

/// The least that a number may be where it divides or has a logarithm.
const ABOVE_ZERO: f64 = 1e-30;
/// The least that a number may be where it may be anything.
const ANY: f64 = -1e6;

/// Why a file is no table of published fits.
#[derive(Debug, thiserror::Error)]
pub enum PublishedFitError {
    /// The file system says no.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What it says.
        source: io::Error,
    },
    /// Something else than the parameters of a material.
    #[error("{}, line {line}: expected {expected}, found {found}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Counted from 1.
        line: usize,
        /// What was expected.
        expected: String,
        /// What was found.
        found: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    const ABC: &str = "merl_name,kD_r,kD_g,kD_b,A_r,A_g,A_b,B,C,ior\nbrick,0.1,0.2,0.3,5,6,7,1e4,1.2,1.5\n";

    fn abc_of(text: &str) -> Result<Vec<(String, Abc)>, PublishedFitError> {
        Table::parse(Path::new("fits.csv"), text)?.rows(abc_of_row)
    }

    #[test]
    fn columns_are_found_by_name_in_any_order() {
        let parsed = abc_of(ABC).unwrap();
        let brick = Abc { diffuse: Rgb([0.1, 0.2, 0.3]), a: Rgb([5.0, 6.0, 7.0]), b: 1e4, c: 1.2, ior: 1.5 };
        assert_eq!(parsed, [("brick".to_owned(), brick)]);
        let turned: String =
            ABC.lines().map(|line| line.split(',').rev().collect::<Vec<_>>().join(",") + "\n").collect();
        assert_eq!(abc_of(&turned).unwrap(), parsed);
    }

    #[test]
    fn damaged_tables_are_refused_with_file_and_line() {
        let cases = [
            (String::new(), "line 1: expected a heading with the column merl_name, found the end"),
            (ABC.replace("ior", "n"), "line 1: expected a heading with the column ior"),
            (ABC.replace("A_r", "A_g"), "line 1: expected every column once, found A_g twice"),
            (ABC.replace(",1.5", ""), "line 2: expected 10 fields, found 9"),
            (ABC.replace("1e4", "wide"), "line 2: expected a finite number for B, found 'wide'"),
            (ABC.replace("1e4", "NaN"), "line 2: expected a finite number for B, found 'NaN'"),
            (ABC.replace("1e4", "1e300"), "line 2: expected a number of size 3e38 at most for B, found 1e300"),
            (ABC.replace("1.5", "0.5"), "line 2: expected at least 1 for ior, found 0.5"),
            (ABC.replace("brick", " "), "line 2: expected the name of a material, found none"),
            (
                format!("{ABC}{}", ABC.lines().last().unwrap()),
                "line 3: expected every material once, found 'brick' again",
            ),
            (ABC.lines().next().unwrap().to_owned(), "line 2: expected a material, found the end"),
        ];
        for (text, says) in cases {
            let error = abc_of(&text).unwrap_err().to_string();
            assert!(error.starts_with("fits.csv, ") && error.contains(says), "{says}: {error}");
        }
        let error = abc(Path::new("nowhere/fits.csv")).unwrap_err().to_string();
        assert!(error.starts_with("nowhere/fits.csv: "), "{error}");
    }
}
