//! Components of vectors too long to be held all at once.

use std::ops::Range;

use rayon::prelude::*;

use super::{
    Centre, Pca, PcaError, check_count, combine, component_weights, dot_double, gram, subtract, with_fixed_sign,
};

/// Numbers of each vector held at a time: 1.6 MB. A multiple of 3, so that cells stay whole.
const PIECE: usize = 3 << 17;

impl Pca {
    /// Learns `count` components from `rows` vectors of `length` numbers, of which `read` gives a range of one vector;
    /// ranges begin and end at multiples of 3 if `length` does. Every range is asked for twice, since the products of whole
    /// vectors must be known before the first component is; no more than a piece of the vectors is ever held.
    pub fn learn_in_pieces(
        rows: usize,
        length: usize,
        read: &(dyn Fn(usize, Range<usize>) -> Vec<f32> + Sync),
        centre: Centre,
        count: usize,
    ) -> Result<Self, PcaError> {
        check_count(rows, count)?;
        let pieces = || (0..length).step_by(PIECE).map(|start| start..(start + PIECE).min(length));
        let read = |piece: &Range<usize>| -> Vec<Vec<f32>> {
            (0..rows).into_par_iter().map(|row| read(row, piece.clone())).collect()
        };
        let mut products: Vec<Vec<f64>> = (0..rows).map(|row| vec![0.0; row + 1]).collect();
        let mut mean = Vec::with_capacity(length);
        for piece in pieces() {
            let mut rows = read(&piece);
            let own = centre.of(&rows);
            subtract(&mut rows, &own);
            mean.extend(own);
            for (sums, products) in products.iter_mut().zip(gram(&rows, dot_double)) {
                sums.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
            }
        }
        let weights = component_weights(&products, count)?;
        let mut components: Vec<Vec<f32>> = weights.iter().map(|_| Vec::with_capacity(length)).collect();
        for piece in pieces() {
            let mut rows = read(&piece);
            subtract(&mut rows, &mean[piece.clone()]);
            let zero = vec![0.0; piece.len()];
            for (component, weights) in components.iter_mut().zip(&weights) {
                component.extend(combine(&zero, weights, &rows));
            }
        }
        let components = components.into_iter().map(with_fixed_sign).collect();
        Ok(Self { components, mean }.orthonormal())
    }
}
