//! Matrix products for training, in parallel and with the same bits for any number of threads.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

/// Columns or rows of a product that one task makes.
const PIECE: usize = 128;

/// `out` = `a` · `b`.
///
/// Cut into pieces at fixed places, never within a sum: who computes a piece does not matter.
pub(crate) fn multiply(out: MatMut<f32>, a: MatRef<f32>, b: MatRef<f32>) {
    let (rows, columns) = (out.nrows(), out.ncols());
    if columns > PIECE && columns >= rows {
        let at = halfway(columns);
        let ((left, right), (b_left, b_right)) = (out.split_at_col_mut(at), b.split_at_col(at));
        rayon::join(|| multiply(left, a, b_left), || multiply(right, a, b_right));
    } else if rows > PIECE {
        let at = halfway(rows);
        let ((top, bottom), (a_top, a_bottom)) = (out.split_at_row_mut(at), a.split_at_row(at));
        rayon::join(|| multiply(top, a_top, b), || multiply(bottom, a_bottom, b));
    } else {
        matmul(out, Accum::Replace, a, b, 1.0, Par::Seq);
    }
}

/// The multiple of [`PIECE`] nearest to the middle.
const fn halfway(length: usize) -> usize {
    length.div_ceil(PIECE).div_ceil(2) * PIECE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_make_the_whole_product() {
        for (rows, inner, columns) in [(1, 1, 1), (96, 40, 300), (300, 17, 96), (129, 3, 129), (512, 5, 24)] {
            let a: Vec<f32> = (0..rows * inner).map(|i| (i as f32 * 0.37).sin()).collect();
            let b: Vec<f32> = (0..inner * columns).map(|i| (i as f32 * 0.11).cos()).collect();
            let mut out = vec![0.0; rows * columns];
            let [a_matrix, b_matrix] =
                [(&a, rows, inner), (&b, inner, columns)].map(|(v, r, c)| MatRef::from_row_major_slice(v, r, c));
            multiply(MatMut::from_row_major_slice_mut(&mut out, rows, columns), a_matrix, b_matrix);
            for (place, own) in out.iter().enumerate() {
                let (row, column) = (place / columns, place % columns);
                let plain: f32 = (0..inner).map(|k| a[row * inner + k] * b[k * columns + column]).sum();
                assert!((own - plain).abs() < 1e-4, "{rows} {inner} {columns}: {own} {plain}");
            }
        }
    }
}
