//! How well coordinates keep distances along a manifold.
//!
//! Distances along the manifold are shortest ways over the graph of nearest neighbours (J. Tenenbaum, V. de Silva and
//! J. Langford, *A Global Geometric Framework for Nonlinear Dimensionality Reduction*, 2000). Stress is J. Kruskal's
//! (*Multidimensional Scaling by Optimizing Goodness of Fit*, 1964, formula one), after the best common scale.

use super::vector::squared_distance;

/// Distances in coordinates against distances along the manifold.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Distortion {
    /// Pearson's correlation, −1..1; 1 is best.
    pub correlation: f64,
    /// √(Σ (s·d − g)² / Σ g²) with the best scale s, 0..1; 0 is best.
    pub stress: f64,
}

impl Distortion {
    /// Over pairs of (distance in coordinates, distance along the manifold); 0 and 1, the worst, for no pairs.
    pub fn of(pairs: &[(f64, f64)]) -> Self {
        let count = pairs.len().max(1) as f64;
        let sum = |f: &dyn Fn(f64, f64) -> f64| pairs.iter().map(|&(d, g)| f(d, g)).sum::<f64>();
        let (mean_d, mean_g) = (sum(&|d, _| d) / count, sum(&|_, g| g) / count);
        let common = sum(&|d, g| (d - mean_d) * (g - mean_g));
        let spread = (sum(&|d, _| (d - mean_d).powi(2)) * sum(&|_, g| (g - mean_g).powi(2))).sqrt();
        let (dd, dg, gg) = (sum(&|d, _| d * d), sum(&|d, g| d * g), sum(&|_, g| g * g));
        let explained = if dd > 0.0 && gg > 0.0 { dg * dg / (dd * gg) } else { 0.0 };
        Self {
            correlation: if spread > 0.0 { common / spread } else { 0.0 },
            stress: (1.0 - explained).max(0.0).sqrt(),
        }
    }
}

/// Shortest ways between all points over the graph in which each is joined to its `neighbours` nearest, or to more where
/// the graph would fall apart; \[points, points\].
pub fn geodesics(points: &[Vec<f64>], neighbours: usize) -> Vec<Vec<f64>> {
    let n = points.len();
    let straight: Vec<Vec<f64>> =
        points.iter().map(|a| points.iter().map(|b| squared_distance(a, b).sqrt()).collect()).collect();
    let mut neighbours = neighbours.max(1);
    loop {
        let ways = shortest(joined(&straight, neighbours));
        if neighbours >= n || ways.iter().flatten().all(|way| way.is_finite()) {
            return ways;
        }
        neighbours += 1;
    }
}

/// Lengths of edges, infinite where there is none.
fn joined(straight: &[Vec<f64>], neighbours: usize) -> Vec<Vec<f64>> {
    let n = straight.len();
    let mut edges = vec![vec![f64::INFINITY; n]; n];
    for (i, row) in straight.iter().enumerate() {
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| row[a].total_cmp(&row[b]));
        for &j in order.iter().take(neighbours + 1).chain([&i]) {
            let length = if i == j { 0.0 } else { row[j] };
            (edges[i][j], edges[j][i]) = (length, length);
        }
    }
    edges
}

/// R. Floyd, *Algorithm 97: Shortest Path* (1962).
fn shortest(mut ways: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for via in 0..ways.len() {
        let from_via = ways[via].clone();
        for row in &mut ways {
            let to_via = row[via];
            row.iter_mut().zip(&from_via).for_each(|(way, rest)| *way = way.min(to_via + rest));
        }
    }
    ways
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_along_a_circle_are_arcs_but_across_the_gap() {
        let circle: Vec<Vec<f64>> = (0..=300).map(|k| f64::from(k) * 0.02).map(|t| vec![t.cos(), t.sin()]).collect();
        let ways = geodesics(&circle, 3);
        assert!((ways[0][150] - 3.0).abs() < 1e-3 && (ways[0][299] - 5.98).abs() < 1e-2, "{}", ways[0][299]);
    }

    #[test]
    fn islands_are_joined_and_a_scale_is_no_distortion() {
        let islands: Vec<Vec<f64>> = [0.0, 1.0, 2.0, 50.0, 51.0, 52.0].map(|x| vec![x]).to_vec();
        let ways = geodesics(&islands, 1);
        assert!(ways.iter().flatten().all(|way| way.is_finite()));
        let pairs: Vec<(f64, f64)> = ways[0].iter().map(|&way| (3.0 * way, way)).collect();
        let found = Distortion::of(&pairs);
        assert!(found.stress < 1e-6 && found.correlation > 1.0 - 1e-9, "{found:?}");
        assert_eq!(Distortion::of(&[]), Distortion { correlation: 0.0, stress: 1.0 });
    }
}
