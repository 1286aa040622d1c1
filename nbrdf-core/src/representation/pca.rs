//! Principal components of long vectors, learned from few of them.
//!
//! The eigenvectors of the small Gram matrix give the components (Turk and Pentland 1991, section 2), so that neither a
//! covariance nor an SVD of the long side is ever formed. Products are summed in f32 over short pieces, these in f64.

mod file;
mod pieces;

use faer::{Mat, Side};
use rayon::prelude::*;

use super::values::Values;

/// Mean and orthonormal components.
pub struct Pca {
    /// The vector whose coordinates are 0: the mean of the training vectors, or another [`Centre`] of theirs.
    pub mean: Vec<f32>,
    /// Components, largest variance first, each as long as the mean.
    pub components: Vec<Vec<f32>>,
}

/// About what components are learned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Centre {
    /// The mean: components of largest variance.
    Mean,
    /// The median, number by number, of values of this kind: components of largest mean square about it.
    Median(Values),
}

impl Centre {
    /// Of rows of equal length; there is at least one.
    fn of(self, rows: &[Vec<f32>]) -> Vec<f32> {
        let Self::Median(values) = self else { return mean(rows) };
        let middle = |column: usize| {
            let mut sorted: Vec<f32> = rows.iter().map(|row| row[column]).collect();
            sorted.sort_unstable_by(f32::total_cmp);
            values.median(&sorted)
        };
        (0..rows[0].len()).into_par_iter().map(middle).collect()
    }
}

/// Why components could not be learned.
#[derive(Debug, thiserror::Error)]
pub enum PcaError {
    /// Not more vectors than components.
    #[error("{components} components need more than {components} training materials, found {found}")]
    TooFew {
        /// Components asked for.
        components: usize,
        /// Training vectors.
        found: usize,
    },
    /// The eigenvalues did not converge (values that are not finite).
    #[error("the training materials have no principal components: are all values finite?")]
    NoConvergence,
}

/// Numbers that are combined at once: they stay in the cache.
const PIECE: usize = 4096;

impl Pca {
    /// Learns `count` components from `rows` of equal length. Those a thousand times smaller than the first are rounding.
    pub fn learn(rows: Vec<Vec<f32>>, count: usize) -> Result<Self, PcaError> {
        Self::of_products(rows, Centre::Mean, count, dot)
    }

    /// As [`learn`](Self::learn), about another centre, and with products in f64: for rows of which a few numbers are much
    /// larger than all others.
    pub fn learn_about(rows: Vec<Vec<f32>>, centre: Centre, count: usize) -> Result<Self, PcaError> {
        Ok(Self::of_products(rows, centre, count, dot_double)?.orthonormal())
    }

    /// Components that rounding left only nearly at right angles, at right angles: a small one would otherwise take part in
    /// what belongs to a large one (Gram and Schmidt, from the largest on).
    fn orthonormal(mut self) -> Self {
        for place in 0..self.components.len() {
            let (before, others) = self.components.split_at_mut(place);
            let overlap = |larger: &Vec<f32>| -dot_double(&others[0], larger) as f32;
            let overlaps: Vec<f32> = before.par_iter().map(overlap).collect();
            let mut component = combine(&others[0], &overlaps, before);
            let scale = 1.0 / dot_double(&component, &component).max(1e-30).sqrt() as f32;
            component.iter_mut().for_each(|v| *v *= scale);
            others[0] = component;
        }
        self
    }

    fn of_products(mut rows: Vec<Vec<f32>>, centre: Centre, count: usize, dot: Product) -> Result<Self, PcaError> {
        check_count(rows.len(), count)?;
        let mean = centre.of(&rows);
        subtract(&mut rows, &mean);
        let weights = component_weights(&gram(&rows, dot), count)?;
        combine_in_place(&weights, &mut rows);
        Ok(Self { components: rows.into_par_iter().map(with_fixed_sign).collect(), mean })
    }

    /// Bytes of mean and components.
    pub fn bytes(&self) -> usize {
        size_of::<f32>() * self.mean.len() * (1 + self.components.len())
    }

    /// Coordinates of the nearest point of the learned subspace.
    pub fn project(&self, row: &[f32]) -> Vec<f32> {
        let centred: Vec<f32> = row.iter().zip(&self.mean).map(|(v, m)| v - m).collect();
        self.components.par_iter().map(|component| dot(&centred, component) as f32).collect()
    }

    /// The vector with these coordinates.
    pub fn reconstruct(&self, code: &[f32]) -> Vec<f32> {
        combine(&self.mean, code, &self.components)
    }
}

fn check_count(found: usize, components: usize) -> Result<(), PcaError> {
    if found > components { Ok(()) } else { Err(PcaError::TooFew { components, found }) }
}

fn subtract(rows: &mut [Vec<f32>], mean: &[f32]) {
    rows.par_iter_mut().for_each(|row| row.iter_mut().zip(mean).for_each(|(v, m)| *v -= m));
}

/// Products of all rows with each other, row i with rows 0..=i.
fn gram(rows: &[Vec<f32>], dot: Product) -> Vec<Vec<f64>> {
    (0..rows.len()).into_par_iter().map(|i| (0..=i).map(|j| dot(&rows[i], &rows[j])).collect()).collect()
}

/// What every row counts in each of the first `count` components, from the products of all rows.
fn component_weights(gram: &[Vec<f64>], count: usize) -> Result<Vec<Vec<f32>>, PcaError> {
    let n = gram.len();
    let gram = Mat::from_fn(n, n, |i, j| gram[i.max(j)][i.min(j)]);
    let eigen = gram.self_adjoint_eigen(Side::Lower).map_err(|_| PcaError::NoConvergence)?;
    let weights = |k: usize| {
        // faer sorts eigenvalues upwards
        let column = n - 1 - k;
        let scale = 1.0 / eigen.S().column_vector()[column].max(1e-30).sqrt();
        (0..n).map(|i| (eigen.U()[(i, column)] * scale) as f32).collect()
    };
    Ok((0..count).map(weights).collect())
}

/// Eigenvectors come with either sign; this one's largest number is positive.
fn with_fixed_sign(mut component: Vec<f32>) -> Vec<f32> {
    let largest = component.iter().fold(0.0f32, |largest, v| if v.abs() > largest.abs() { *v } else { largest });
    if largest < 0.0 {
        component.iter_mut().for_each(|v| *v = -*v);
    }
    component
}

/// `base + Σ weight · row`, in pieces that stay in the cache.
fn combine(base: &[f32], weights: &[f32], rows: &[Vec<f32>]) -> Vec<f32> {
    let mut out = base.to_vec();
    out.par_chunks_mut(PIECE).enumerate().for_each(|(piece, out)| {
        add_up(out, weights, rows.iter().map(|row| &row[piece * PIECE..]));
    });
    out
}

/// Adds `Σ weight · row` to numbers, row after row.
fn add_up<'a>(out: &mut [f32], weights: &[f32], rows: impl Iterator<Item = &'a [f32]>) {
    for (&weight, row) in weights.iter().zip(rows) {
        out.iter_mut().zip(row).for_each(|(out, v)| *out += weight * v);
    }
}

/// Puts each of a few sums `Σ weight · row` in the place of a row and lets the other rows go: tables are large, and sums
/// beside them would take as much again. The same bits as [`combine`] from zero.
fn combine_in_place(weights: &[Vec<f32>], rows: &mut Vec<Vec<f32>>) {
    let mut pieces: Vec<Vec<&mut [f32]>> = Vec::new();
    for (place, row) in rows.iter_mut().enumerate() {
        for (piece, part) in row.chunks_mut(PIECE).enumerate() {
            if place == 0 {
                pieces.push(Vec::with_capacity(weights.len()));
            }
            pieces[piece].push(part);
        }
    }
    pieces.into_par_iter().for_each(|mut parts| {
        let sum = |weights: &Vec<f32>| {
            let mut out = vec![0.0; parts[0].len()];
            add_up(&mut out, weights, parts.iter().map(|part| &**part));
            out
        };
        let sums: Vec<Vec<f32>> = weights.iter().map(sum).collect();
        parts.iter_mut().zip(sums).for_each(|(part, sum)| part.copy_from_slice(&sum));
    });
    rows.truncate(weights.len());
}

fn mean(rows: &[Vec<f32>]) -> Vec<f32> {
    let zero = vec![0.0; rows[0].len()];
    combine(&zero, &vec![1.0 / rows.len() as f32; rows.len()], rows)
}

/// Sum of the products of two rows.
type Product = fn(&[f32], &[f32]) -> f64;

/// Products and sums in f64.
fn dot_double(a: &[f32], b: &[f32]) -> f64 {
    const LANES: usize = 8;
    let mut sums = [0.0f64; LANES];
    for (a, b) in a.chunks(LANES).zip(b.chunks(LANES)) {
        for (sum, (&a, &b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += f64::from(a) * f64::from(b);
        }
    }
    sums.iter().sum()
}

/// Products in f32, sums of pieces in f64.
fn dot(a: &[f32], b: &[f32]) -> f64 {
    const LANES: usize = 16;
    const PIECE: usize = 1024;
    let piece = |(a, b): (&[f32], &[f32])| -> f64 {
        let mut sums = [0.0f32; LANES];
        for (a, b) in a.chunks(LANES).zip(b.chunks(LANES)) {
            for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
                *sum += a * b;
            }
        }
        f64::from(sums.iter().sum::<f32>())
    };
    a.chunks(PIECE).zip(b.chunks(PIECE)).map(piece).sum()
}

#[cfg(test)]
mod tests;
