//! The table itself: every cell's reflectance is a number of the code.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), section 3: what measuring gives, and what all others are
//! smaller than. Nothing is learned and nothing lost but what lies between the cells.

use half::f16;

use super::{Code, DecodeError, EncodeError, Representation, check_numbers};
use crate::brdf::standard_table::{self, StandardTable};
use crate::brdf::table::{self, CELLS, Lookup, Precision, Table};
use crate::sampling::evaluate;
use crate::{Brdf, Directions, Material, Rgb};

/// Numbers of a code: [`CELLS`], three channels each.
const NUMBERS: usize = 3 * CELLS[0] * CELLS[1] * CELLS[2];
/// Larger reflectances \[1/sr\] are taken as this: sums of eight stay finite.
const LARGEST: f32 = 1e30;

/// Over which angles.
#[derive(Clone, Copy, Debug)]
enum Frame {
    HalfDifference(Lookup, Precision),
    Standard,
}

/// Materials as tables. Numbers of a code are f_r \[1/sr\], index `cell · 3 + channel`, the last angle running fastest;
/// negative ones are taken as 0, and those of cells below the horizon are 0 and not read.
#[derive(Clone, Copy, Debug)]
pub struct Tables {
    name: &'static str,
    frame: Frame,
}

impl Tables {
    /// 32 bits, the nearest cell: how the database's own reader looks up.
    pub const NEAREST: Self = Self::half_difference("table_nearest", Lookup::Nearest, Precision::Single);
    /// 32 bits, interpolated.
    pub const TRILINEAR: Self = Self::half_difference("table", Lookup::Trilinear, Precision::Single);
    /// 16 bits, interpolated.
    pub const HALF: Self = Self::half_difference("table_half", Lookup::Trilinear, Precision::Half);
    /// 32 bits, interpolated, over (θ_i, θ_o, φ) instead of half and difference angles.
    pub const STANDARD: Self = Self { name: "table_standard", frame: Frame::Standard };

    const fn half_difference(name: &'static str, lookup: Lookup, precision: Precision) -> Self {
        Self { name, frame: Frame::HalfDifference(lookup, precision) }
    }

    fn middles(self) -> &'static [Directions] {
        match self.frame {
            Frame::HalfDifference(..) => table::middles(),
            Frame::Standard => standard_table::middles(),
        }
    }

    fn is_half(self) -> bool {
        matches!(self.frame, Frame::HalfDifference(_, Precision::Half))
    }

    /// The table of these numbers.
    fn table(self, numbers: &[f32]) -> Box<dyn Brdf> {
        let (cells, _) = numbers.as_chunks::<3>();
        let values = cells.iter().map(|&cell| Rgb(cell.map(|v| v.clamp(0.0, LARGEST))));
        match self.frame {
            Frame::Standard => Box::new(StandardTable::of_cells(values.collect())),
            Frame::HalfDifference(lookup, precision) => {
                let measured = self.middles().iter().zip(values).map(|(at, value)| at.is_above().then_some(value));
                Box::new(Table::of_cells(measured, lookup).with_precision(precision))
            }
        }
    }
}

impl Representation for Tables {
    fn name(&self) -> &'static str {
        self.name
    }

    fn dim(&self) -> usize {
        NUMBERS
    }

    /// The cells: nothing else is agreed on beforehand.
    fn checkpoint(&self) -> &str {
        "90x90x180"
    }

    fn shared_bytes(&self) -> usize {
        0
    }

    fn code_bytes(&self) -> usize {
        NUMBERS * if self.is_half() { size_of::<f16>() } else { size_of::<f32>() }
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let mut values = evaluate(target.brdf.as_ref(), self.middles());
        if values.iter().any(|value| !value.is_finite()) {
            return Err(EncodeError::NotFinite { material: target.name.clone() });
        }
        if self.is_half() {
            // The numbers that are kept.
            let kept = |v: f32| f16::from_f32(v.min(f16::MAX.to_f32())).to_f32();
            values.iter_mut().for_each(|value| *value = value.map(kept));
        }
        Ok(self.code(bytemuck::cast_slice(&values).to_vec()))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        Ok(self.table(code.checked(self.name, self.checkpoint(), NUMBERS)?))
    }

    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        *place = self.table(check_numbers(self.name, numbers, NUMBERS)?);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::brdf::ggx::Ggx;
    use crate::metric::{Metric, RelativeLog};

    fn glossy() -> Material {
        let ggx = Ggx { diffuse: Rgb([0.3, 0.2, 0.1]), f0: Rgb([0.04, 0.5, 0.9]), alpha: 0.1 };
        Material::new("glossy", Arc::new(ggx))
    }

    #[test]
    fn half_angles_keep_a_highlight_that_angles_of_incidence_lose() {
        let error = |tables: Tables| {
            let code = tables.encode(&glossy()).unwrap();
            RelativeLog.distance(glossy().brdf.as_ref(), tables.decode(&code).unwrap().as_ref())
        };
        let [nearest, trilinear, half, standard] =
            [Tables::NEAREST, Tables::TRILINEAR, Tables::HALF, Tables::STANDARD].map(error);
        assert!(trilinear < 0.3 * nearest && (half / trilinear - 1.0).abs() < 0.3, "{nearest} {trilinear} {half}");
        assert!(standard > 2.0 * trilinear, "{standard} {trilinear}");
    }

    #[test]
    fn codes_of_half_precision_take_half_the_bytes_and_lose_nothing_more_by_decoding() {
        assert_eq!(2 * Tables::HALF.code_bytes(), Tables::TRILINEAR.code_bytes());
        let code = Tables::HALF.encode(&glossy()).unwrap();
        let decoded = Material::new("again", Arc::from(Tables::HALF.decode(&code).unwrap()));
        let again = Tables::HALF.encode(&decoded).unwrap();
        let close = |(a, b): (&f32, &f32)| (a - b).abs() <= 2e-3 * a + 1e-6;
        assert!(code.code.iter().zip(&again.code).all(close));
    }

    #[test]
    fn numbers_beyond_all_bounds_give_finite_reflectances() {
        let table = Tables::TRILINEAR.decode(&Tables::TRILINEAR.code(vec![f32::MAX; NUMBERS])).unwrap();
        let negative = Tables::TRILINEAR.decode(&Tables::TRILINEAR.code(vec![-1.0; NUMBERS])).unwrap();
        for &at in crate::sampling::rus32k().iter().step_by(101) {
            assert!(table.eval(at).is_finite());
            assert_eq!(negative.eval(at), Rgb::BLACK);
        }
    }
}
