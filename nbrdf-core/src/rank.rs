//! How far a table of a reflectance is a sum of few products: the singular values of its numbers as a matrix.
//!
//! Rows are the first angle of the frame, columns the two others and the channel. S. Rusinkiewicz, *A New Change of
//! Variables for Efficient BRDF Representation* (1998), sections 3 and 5, turns features along the angles of half and
//! difference vector, where few products do; J. Lawrence et al., *Efficient BRDF Importance Sampling Using a Factored
//! Representation* (2004), section 3, factors such matrices. Effective rank: O. Roy, M. Vetterli, *The Effective Rank*
//! (2007), equation 5.

use faer::{Mat, Side};
use serde::Serialize;

use crate::brdf::table::CELLS;
use crate::brdf::{standard_table, table};
use crate::representation::values::Values;
use crate::sampling::evaluate;
use crate::{Brdf, Directions, Rgb};

/// Rows of the matrix, and so its singular values.
pub const ROWS: usize = CELLS[0];
/// Numbers in a row.
const COLUMNS: usize = 3 * CELLS[1] * CELLS[2];

/// The angles of a table of 90 × 90 × 180 cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Frame {
    /// θ_half against (θ_diff, φ_diff), θ_half spaced by the square root. A cell below the horizon repeats the one before
    /// it in θ_half, which adds nothing to the rank.
    HalfDifference,
    /// θ_i against (θ_o, φ), evenly spaced.
    Standard,
}

impl Frame {
    /// Both frames.
    pub const ALL: [Self; 2] = [Self::HalfDifference, Self::Standard];

    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::HalfDifference => "half_difference",
            Self::Standard => "standard",
        }
    }

    fn middles(self) -> &'static [Directions] {
        match self {
            Self::HalfDifference => table::middles(),
            Self::Standard => standard_table::middles(),
        }
    }

    /// The numbers of a reflectance's table, row by row.
    fn numbers(self, brdf: &dyn Brdf, values: Values) -> Vec<f32> {
        let at = self.middles();
        let mut numbers: Vec<f32> = Vec::with_capacity(ROWS * COLUMNS);
        for (&at, f) in at.iter().zip(evaluate(brdf, at)) {
            // The first row is above the horizon everywhere.
            let cell = match (at.is_above(), numbers.len().checked_sub(COLUMNS)) {
                (false, Some(before)) => Rgb([0, 1, 2].map(|channel| numbers[before + channel])),
                _ => f.map(|f| values.stored(at, f)),
            };
            numbers.extend(cell.0);
        }
        numbers
    }
}

/// Singular values, falling.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct SingularValues(Vec<f64>);

impl SingularValues {
    /// Of a reflectance's table; `None` where a value is not finite or all are 0. From the eigenvalues of the products of
    /// rows, in f64: what is below 10⁻⁷ of the largest is rounding of the table's numbers.
    pub fn of(brdf: &dyn Brdf, frame: Frame, values: Values) -> Option<Self> {
        let numbers = frame.numbers(brdf, values);
        if numbers.iter().any(|v| !v.is_finite()) {
            return None;
        }
        let matrix = Mat::from_fn(ROWS, COLUMNS, |row, column| f64::from(numbers[row * COLUMNS + column]));
        let gram = &matrix * matrix.transpose();
        let eigen = gram.self_adjoint_eigenvalues(Side::Lower).ok()?;
        let falling: Vec<f64> = eigen.into_iter().rev().map(|v| v.max(0.0).sqrt()).collect();
        (falling[0] > 0.0).then_some(Self(falling))
    }

    /// All of them over the first: 1, falling.
    pub fn normalised(&self) -> Vec<f64> {
        self.0.iter().map(|v| v / self.0[0]).collect()
    }

    /// Share of the sum of squares, 0..1, that the first `rank` products hold.
    pub fn energy(&self, rank: usize) -> f64 {
        let squares = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
        squares(&self.0[..rank.min(self.0.len())]) / squares(&self.0)
    }

    /// The fewest products that hold this share of the sum of squares.
    pub fn rank_for(&self, share: f64) -> usize {
        (1..self.0.len()).find(|&rank| self.energy(rank) >= share).unwrap_or(self.0.len())
    }

    /// exp of the entropy of the values over their sum, 1 to [`ROWS`]: how many of them count.
    pub fn effective_rank(&self) -> f64 {
        let sum: f64 = self.0.iter().sum();
        let shares = self.0.iter().map(|v| v / sum).filter(|share| *share > 0.0);
        (-shares.map(|share| share * share.ln()).sum::<f64>()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::brdf::lambert::Lambert;

    #[test]
    fn a_lambertian_is_one_product_in_the_frame_of_light_and_view() {
        let grey = Lambert { albedo: Rgb([0.2, 0.5, 0.8]) };
        let found = SingularValues::of(&grey, Frame::Standard, Values::Plain).unwrap();
        assert!((found.energy(1) - 1.0).abs() < 1e-9 && found.rank_for(0.999) == 1);
        assert!((found.effective_rank() - 1.0).abs() < 1e-2, "{}", found.effective_rank());
        // Σ_c (albedo_c/π)² times Σ over θ_i of cos², 90 × 180 columns each.
        let cosines: f64 = (0..90u8).map(|i| (f64::from(i) + 0.5).to_radians().cos().max(0.05).powi(2)).sum();
        let colour: f64 = [0.2f64, 0.5, 0.8].iter().map(|a| (a / std::f64::consts::PI).powi(2)).sum();
        assert!((found.0[0] / (16200.0 * colour * cosines).sqrt() - 1.0).abs() < 1e-5, "{}", found.0[0]);
    }

    #[test]
    fn black_has_no_rank() {
        assert_eq!(SingularValues::of(&Lambert { albedo: Rgb::BLACK }, Frame::Standard, Values::Plain), None);
    }

    #[test]
    fn half_angles_need_a_few_products_for_a_mirror_like_lobe_and_other_angles_many_unless_of_logarithms() {
        let chrome = Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(0.55), alpha: 0.03 };
        let effective =
            |values| Frame::ALL.map(|frame| SingularValues::of(&chrome, frame, values).unwrap().effective_rank());
        // NumPy's SVD: 1.83 and 27.6, 3.25 and 2.98.
        let [half, standard] = effective(Values::Plain);
        assert!((half - 1.83).abs() < 0.01 && (standard - 27.59).abs() < 0.1, "{half} {standard}");
        let [half, standard] = effective(Values::Log);
        assert!((half - 3.25).abs() < 0.01 && (standard - 2.98).abs() < 0.01, "{half} {standard}");
    }
}
