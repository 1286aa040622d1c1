//! Both ways between data and chart coordinates.
//!
//! M. Brand, *Charting a Manifold*, section 4. Forward (equation 4): x = Σ_k p_k(y) (L_k W_k (y − μ_k) + t_k). Backward:
//! y = Σ_k p_k(x) (μ_k + W_kᵀ L_k⁺ (x − t_k)). Differs: p_k(x) and the pseudo-inverse are those of x = L_k u + t_k + noise,
//! u ~ N(0, Λ_k), with noise as large as the charts' disagreement; where they agree this is the pseudo-inverse. Farther
//! from a chart's centre than its points are, the local coordinates saturate: every x is some y near the data.

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

use super::ChartingError;
use super::chart::Chart;
use super::connection::Affine;
use super::posterior::{posterior, temperature};
use super::vector::{dot, squared_distance};

/// Standard deviations, times √dim, at which local coordinates saturate.
const REACH: f64 = 4.0;
/// How suddenly: at half the reach a coordinate is short by 0.05 %.
const KNEE: i32 = 8;

/// A chart and its place among the others.
pub(super) struct Placed {
    pub chart: Chart,
    pub map: Affine,
    /// Λ Lᵀ (L Λ Lᵀ + noise)⁻¹.
    gain: Mat<f64>,
    /// (L Λ Lᵀ + noise)⁻¹.
    precision: Mat<f64>,
    log_determinant: f64,
}

/// All charts, connected.
pub(super) struct Mapping {
    pub placed: Vec<Placed>,
    /// Temperature of the posteriors of data, and of coordinates.
    pub temperatures: [f64; 2],
    /// Mean square of a coordinate's disagreement between charts.
    pub noise: f64,
}

impl Mapping {
    /// Charts of these maps; `temperature_of_data` as in the connection, that of coordinates such that the points are
    /// again shared by `shared` charts.
    pub fn new(
        charts: Vec<Chart>,
        maps: Vec<Affine>,
        points: &[Vec<f64>],
        temperature_of_data: f64,
        shared: f64,
    ) -> Result<Self, ChartingError> {
        let dim = maps[0].offset.len();
        let mut mapping = Self::one_way(charts, maps, [temperature_of_data, 1.0]);
        let coordinates: Vec<Vec<f64>> = points.iter().map(|point| mapping.forward(point)).collect();
        let apart = |(point, place): (&Vec<f64>, &Vec<f64>)| {
            let weights = mapping.posterior_of_data(point);
            let of = |(placed, weight): (&Placed, f64)| weight * squared_distance(&placed.forward(point), place);
            mapping.placed.iter().zip(weights).map(of).sum::<f64>()
        };
        let values = (points.len() * dim) as f64;
        let variance = coordinates.iter().map(|x| dot(x, x)).sum::<f64>() / values;
        let disagreement = points.iter().zip(&coordinates).map(apart).sum::<f64>() / values;
        mapping.invert(disagreement.max(1e-10 * variance))?;
        let densities: Vec<Vec<f64>> = coordinates.iter().map(|x| mapping.log_densities(x)).collect();
        mapping.temperatures[1] = temperature(&densities, shared);
        Ok(mapping)
    }

    /// Charts of these maps, with the noise and the temperatures that were found for them.
    pub fn of_noise(
        charts: Vec<Chart>,
        maps: Vec<Affine>,
        noise: f64,
        temperatures: [f64; 2],
    ) -> Result<Self, ChartingError> {
        let mut mapping = Self::one_way(charts, maps, temperatures);
        mapping.invert(noise)?;
        Ok(mapping)
    }

    /// The way forward alone.
    fn one_way(charts: Vec<Chart>, maps: Vec<Affine>, temperatures: [f64; 2]) -> Self {
        let dim = maps[0].offset.len();
        let identity = || Mat::<f64>::identity(dim, dim);
        let place = |(chart, map)| Placed { chart, map, gain: identity(), precision: identity(), log_determinant: 0.0 };
        Self { placed: charts.into_iter().zip(maps).map(place).collect(), temperatures, noise: 0.0 }
    }

    /// The way back.
    fn invert(&mut self, noise: f64) -> Result<(), ChartingError> {
        self.noise = noise;
        self.placed.iter_mut().try_for_each(|placed| placed.invert(noise))
    }

    /// Chart coordinates of a point.
    pub fn forward(&self, point: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; self.placed[0].map.offset.len()];
        for (placed, weight) in self.placed.iter().zip(self.posterior_of_data(point)) {
            if weight > 0.0 {
                sum.iter_mut().zip(placed.forward(point)).for_each(|(sum, x)| *sum += weight * x);
            }
        }
        sum
    }

    /// The point at these coordinates; finite for those below 10¹⁰⁰.
    pub fn backward(&self, coordinates: &[f64]) -> Vec<f64> {
        let weights = posterior(&self.log_densities(coordinates), self.temperatures[1]);
        let mut sum = vec![0.0; self.placed[0].chart.mean.len()];
        for (placed, weight) in self.placed.iter().zip(weights) {
            if weight > 0.0 {
                placed.add_backward(coordinates, weight, &mut sum);
            }
        }
        sum
    }

    fn posterior_of_data(&self, point: &[f64]) -> Vec<f64> {
        let densities: Vec<f64> = self.placed.iter().map(|placed| placed.chart.log_density(point)).collect();
        posterior(&densities, self.temperatures[0])
    }

    fn log_densities(&self, coordinates: &[f64]) -> Vec<f64> {
        self.placed.iter().map(|placed| placed.log_density(coordinates)).collect()
    }
}

impl Placed {
    fn forward(&self, point: &[f64]) -> Vec<f64> {
        let local = self.chart.local(point);
        self.map.offset.iter().enumerate().map(|(c, t)| t + row_times(&self.map.linear, c, &local)).collect()
    }

    fn invert(&mut self, noise: f64) -> Result<(), ChartingError> {
        let dim = self.map.offset.len();
        let linear = &self.map.linear;
        let scaled = Mat::from_fn(dim, dim, |a, b| self.chart.variances[a] * linear[(b, a)]);
        let mut covariance = linear * &scaled;
        (0..dim).for_each(|c| covariance[(c, c)] += noise);
        let factor = Llt::new(covariance.as_ref(), Side::Lower).map_err(|_| ChartingError::NoConvergence)?;
        self.log_determinant = 2.0 * (0..dim).map(|c| factor.L()[(c, c)].ln()).sum::<f64>();
        self.precision = factor.solve(Mat::<f64>::identity(dim, dim));
        self.gain = scaled * &self.precision;
        Ok(())
    }

    fn offset(&self, coordinates: &[f64]) -> Vec<f64> {
        coordinates.iter().zip(&self.map.offset).map(|(x, t)| x - t).collect()
    }

    fn log_density(&self, coordinates: &[f64]) -> f64 {
        let offset = self.offset(coordinates);
        let weighted: f64 = (0..offset.len()).map(|c| offset[c] * row_times(&self.precision, c, &offset)).sum();
        -0.5 * (weighted + self.log_determinant)
    }

    fn add_backward(&self, coordinates: &[f64], weight: f64, sum: &mut [f64]) {
        let offset = self.offset(coordinates);
        let mut local: Vec<f64> = (0..offset.len()).map(|c| row_times(&self.gain, c, &offset)).collect();
        saturate(&mut local, &self.chart.variances);
        sum.iter_mut().zip(&self.chart.mean).for_each(|(sum, m)| *sum += weight * m);
        for (u, axis) in local.iter().zip(&self.chart.axes) {
            sum.iter_mut().zip(axis).for_each(|(sum, a)| *sum += weight * u * a);
        }
    }
}

/// Scales u such that it stays within reach.
fn saturate(local: &mut [f64], variances: &[f64]) {
    let deviations = local.iter().zip(variances).map(|(u, v)| u * u / v).sum::<f64>().sqrt();
    let far = deviations / (REACH * (local.len() as f64).sqrt());
    let knee = |ratio: f64| (1.0 + ratio.powi(KNEE)).powf(-1.0 / f64::from(KNEE));
    // The same function on both sides of 1; neither overflows.
    let scale = if far <= 1.0 { knee(far) } else { knee(1.0 / far) / far };
    local.iter_mut().for_each(|u| *u *= scale);
}

fn row_times(matrix: &Mat<f64>, row: usize, vector: &[f64]) -> f64 {
    vector.iter().enumerate().map(|(column, v)| matrix[(row, column)] * v).sum()
}
