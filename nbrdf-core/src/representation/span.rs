//! A linear space of materials, asked at fixed places: many points of it, at many numbers of components, without their
//! tables.
//!
//! Reading a table is linear in its numbers, and these are linear in the code: the mean and every component are read once.

use rayon::prelude::*;

use super::pca_tables::{PcaOptions, PcaTables};
use super::value_table::interpolated;
use super::values::Values;
use crate::{Directions, Rgb};

/// What [`PcaTables`] span, at some pairs of directions.
pub struct Span {
    /// The pairs under which the places are looked up; none below the surface, where all is black.
    at: Vec<Option<Directions>>,
    values: Values,
    mean: Vec<Rgb>,
    components: Vec<Vec<Rgb>>,
}

impl Span {
    /// Reads mean and components at every pair.
    pub fn new(tables: &PcaTables, at: &[Directions]) -> Self {
        let PcaOptions { grid, values, .. } = tables.options;
        let at: Vec<_> = at.iter().map(|&at| at.is_above().then(|| grid.folded(at))).collect();
        let around: Vec<_> = at.par_iter().map(|at| at.map(|at| grid.around(at))).collect();
        let read = |numbers: &Vec<f32>| -> Vec<Rgb> {
            around.iter().map(|around| around.map_or(Rgb::BLACK, |around| interpolated(numbers, &around))).collect()
        };
        let components = tables.pca.components.par_iter().map(read).collect();
        Self { mean: read(&tables.pca.mean), components, at, values }
    }

    /// f_r \[1/sr\], before the clamp at zero, of the first `counts` numbers of a code, the others taken as 0; `counts` rise.
    /// Calls `visit` with the place of the count in the list and the values at every pair.
    ///
    /// # Panics
    /// If a count is larger than the code or the space (a bug of the caller).
    pub fn prefixes(&self, code: &[f32], counts: &[usize], mut visit: impl FnMut(usize, &[Rgb])) {
        let mut stored = self.mean.clone();
        let mut values = vec![Rgb::BLACK; stored.len()];
        let mut done = 0;
        for (place, &count) in counts.iter().enumerate() {
            for (component, &number) in self.components[done..count].iter().zip(&code[done..count]) {
                let sums = Rgb::flat_mut(&mut stored).iter_mut();
                sums.zip(Rgb::flat(component)).for_each(|(sum, v)| *sum += number * v);
            }
            done = count;
            for ((value, &stored), at) in values.iter_mut().zip(&stored).zip(&self.at) {
                *value = at.map_or(Rgb::BLACK, |at| self.values.reflectance(at, stored));
            }
            visit(place, &values);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Representation;
    use crate::library::builtin;
    use crate::sampling::{evaluate_signed, rus32k};

    #[test]
    fn values_at_the_places_are_those_of_the_decoded_code() {
        let materials: Vec<_> = builtin::shared().materials().into_iter().step_by(20).collect();
        let at: Vec<Directions> = rus32k().iter().step_by(97).copied().collect();
        for values in Values::ALL {
            let options = PcaOptions { components: 4, values, ..PcaOptions::LOG_45 };
            let tables = PcaTables::learn(&materials, options).unwrap();
            let code = tables.encode(&materials[1]).unwrap();
            let span = Span::new(&tables, &at);
            span.prefixes(&code.code, &[2, 4], |place, found| {
                let mut numbers = code.code.clone();
                numbers[if place == 0 { 2 } else { 4 }..].fill(0.0);
                let decoded = tables.decode(&tables.code(numbers)).unwrap();
                for (a, b) in evaluate_signed(decoded.as_ref(), &at).iter().zip(found) {
                    assert!(a.zip(*b, |a, b| (a - b).abs() / (0.1 + a.abs())).max() < 1e-3, "{a:?} {b:?}");
                }
            });
        }
    }
}
