//! Charting as a whole: neighbourhoods, local projections, their connection, both mappings.

use faer::Mat;
use rayon::prelude::*;

use super::chart::Chart;
use super::connection::{Affine, connect};
use super::isometry::{isometric, to_principal_axes};
use super::kernel::{CoLocality, covariances};
use super::mapping::Mapping;
use super::posterior::{posterior, temperature};
use super::vector::spread_out;
use super::{ChartingError, MAX_DIM};

/// What there is to choose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Coordinates of a point.
    pub dim: usize,
    /// Charts at most; the paper has one per point.
    pub charts: usize,
    /// A neighbourhood's kernel falls to e⁻² at the neighbour of this number.
    pub neighbours: usize,
    /// Charts that share a point, at least, on average.
    pub shared: f64,
    /// Added to the mean square of local coordinates when charts are connected, relative to the chart's variance.
    pub ridge: f64,
}

impl Options {
    /// For the 80 training materials, with as many coordinates as in Matusik et al. (2003). Chosen on the validation
    /// materials, without having seen them.
    pub const MATERIALS: Self = Self { dim: 15, charts: usize::MAX, neighbours: 20, shared: 32.0, ridge: 1e-4 };
    /// For a map of the 80 training materials; chosen likewise.
    pub const MAP: Self = Self { dim: 2, charts: usize::MAX, neighbours: 20, shared: 12.0, ridge: 1e-3 };

    /// For densely sampled manifolds.
    pub const fn new(dim: usize) -> Self {
        Self { dim, charts: usize::MAX, neighbours: 4 + 2 * dim, shared: dim as f64 + 1.0, ridge: 1e-8 }
    }
}

/// Charts of a manifold, connected into one.
pub struct Atlas {
    pub(super) mapping: Mapping,
    pub(super) agreement: Vec<f64>,
    pub(super) dim: usize,
}

impl Atlas {
    /// Learns the manifold that `points` of equal length lie on; the same points give the same bits.
    pub fn learn(points: &[Vec<f64>], options: Options) -> Result<Self, ChartingError> {
        let Options { dim, .. } = options;
        let length = points.first().map_or(0, Vec::len);
        if dim == 0 || length < dim || points.len() <= dim + 1 {
            return Err(ChartingError::TooFew { dim, points: points.len(), length });
        }
        if dim > MAX_DIM {
            return Err(ChartingError::TooMany { dim });
        }
        if points.iter().any(|point| point.len() != length || point.iter().any(|v| !v.is_finite())) {
            return Err(ChartingError::NotFinite);
        }
        let chosen = if options.charts < points.len() {
            spread_out(points, options.charts.max(1))
        } else {
            (0..points.len()).collect()
        };
        let centres: Vec<Vec<f64>> = chosen.iter().map(|&i| points[i].clone()).collect();
        let near = CoLocality::new(points, &centres, options.neighbours)?;
        let covariances = covariances(points, &centres, &near);
        let charts: Option<Vec<Chart>> = centres
            .par_iter()
            .zip(&covariances)
            .map(|(centre, covariance)| Chart::new(centre, covariance, dim))
            .collect();
        let charts = charts.ok_or(ChartingError::NoConvergence)?;
        let densities: Vec<Vec<f64>> =
            points.par_iter().map(|point| charts.iter().map(|chart| chart.log_density(point)).collect()).collect();
        let temperature = temperature(&densities, options.shared);
        let (charts, weights) = used(charts, densities.iter().map(|row| posterior(row, temperature)).collect());
        let local: Vec<Vec<Vec<f64>>> =
            charts.par_iter().map(|chart| points.iter().map(|point| chart.local(point)).collect()).collect();
        let ridge = |chart: &Chart| options.ridge * chart.variances.iter().sum::<f64>() / dim as f64;
        let connection = connect(&local, &weights, &charts.iter().map(ridge).collect::<Vec<f64>>())?;
        let maps = straightened(&connection.maps, &local, &weights)?;
        let mapping = Mapping::new(charts, maps, points, temperature, options.shared)?;
        Ok(Self { mapping, agreement: connection.agreement, dim })
    }

    /// Coordinates of a point.
    pub const fn dim(&self) -> usize {
        self.dim
    }

    /// Charts.
    pub fn charts(&self) -> usize {
        self.mapping.placed.len()
    }

    /// Share of each coordinate's variance on which charts agree before coordinates are straightened, 0..1.
    pub fn agreement(&self) -> &[f64] {
        &self.agreement
    }

    /// Chart coordinates of a point of the data space, in the data's units.
    ///
    /// # Panics
    /// If the point is of another length than those learned from (a bug of the caller).
    pub fn forward(&self, point: &[f64]) -> Vec<f64> {
        assert_eq!(point.len(), self.mapping.placed[0].chart.mean.len(), "numbers of a point");
        self.mapping.forward(point)
    }

    /// The point of the data space at these coordinates; finite for finite ones below 10¹⁰⁰.
    ///
    /// # Panics
    /// If there are more or fewer coordinates than [`dim`](Self::dim) (a bug of the caller).
    pub fn backward(&self, coordinates: &[f64]) -> Vec<f64> {
        assert_eq!(coordinates.len(), self.dim, "coordinates");
        self.mapping.backward(coordinates)
    }

    /// Numbers that both mappings read.
    pub fn numbers(&self) -> usize {
        let of = |chart: &Chart| chart.mean.len() * (self.dim + 1) + self.dim * (3 * self.dim + 2) + 3;
        self.mapping.placed.iter().map(|placed| of(&placed.chart)).sum()
    }
}

/// Without the charts that no point belongs to, not even their centre: there is nothing to connect them by.
fn used(charts: Vec<Chart>, weights: Vec<Vec<f64>>) -> (Vec<Chart>, Vec<Vec<f64>>) {
    let is_used: Vec<bool> = (0..charts.len()).map(|k| weights.iter().any(|row| row[k] > 0.0)).collect();
    let kept =
        |row: Vec<f64>| row.into_iter().zip(&is_used).filter_map(|(weight, used)| used.then_some(weight)).collect();
    let weights = weights.into_iter().map(kept).collect();
    (charts.into_iter().zip(&is_used).filter_map(|(chart, used)| used.then_some(chart)).collect(), weights)
}

/// Maps after the affine map that keeps lengths best and puts the coordinates on their principal axes.
fn straightened(maps: &[Affine], local: &[Vec<Vec<f64>>], weights: &[Vec<f64>]) -> Result<Vec<Affine>, ChartingError> {
    let dim = maps[0].offset.len();
    let of_chart: Vec<f64> = (0..maps.len()).map(|k| weights.iter().map(|row| row[k]).sum()).collect();
    let lengths = isometric(maps, &of_chart)?;
    let coordinate = |i: usize, c: usize| -> f64 {
        let of = |k: usize| {
            let linear: f64 = (0..dim).map(|a| maps[k].linear[(c, a)] * local[k][i][a]).sum();
            weights[i][k] * (maps[k].offset[c] + linear)
        };
        (0..maps.len()).map(of).sum()
    };
    let coordinates: Vec<Vec<f64>> =
        (0..weights.len()).into_par_iter().map(|i| (0..dim).map(|c| coordinate(i, c)).collect()).collect();
    let by = to_principal_axes(&lengths, &coordinates)?;
    let moved = |map: &Affine| {
        let offset = &by * Mat::from_fn(dim, 1, |c, _| map.offset[c]);
        Affine { linear: &by * &map.linear, offset: (0..dim).map(|c| offset[(c, 0)]).collect() }
    };
    Ok(maps.iter().map(moved).collect())
}
