//! Short vectors in f64.

/// Σ a b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// |a − b|².
pub(super) fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// Mean of each number.
pub(super) fn mean(points: &[Vec<f64>]) -> Vec<f64> {
    let mut sum = vec![0.0; points.first().map_or(0, Vec::len)];
    for point in points {
        sum.iter_mut().zip(point).for_each(|(sum, v)| *sum += v);
    }
    sum.iter_mut().for_each(|v| *v /= points.len() as f64);
    sum
}

/// Points that lie far from each other: the one nearest the mean, then always the one farthest from those chosen
/// (T. Gonzalez, *Clustering to Minimize the Maximum Intercluster Distance*, 1985).
pub(super) fn spread_out(points: &[Vec<f64>], count: usize) -> Vec<usize> {
    let middle = mean(points);
    let from_middle: Vec<f64> = points.iter().map(|point| squared_distance(point, &middle)).collect();
    let first = (0..points.len()).min_by(|&a, &b| from_middle[a].total_cmp(&from_middle[b]));
    let mut chosen: Vec<usize> = first.into_iter().collect();
    let mut away = vec![f64::INFINITY; points.len()];
    while chosen.len() < count.min(points.len()) {
        let last = &points[chosen[chosen.len() - 1]];
        away.iter_mut().zip(points).for_each(|(away, point)| *away = away.min(squared_distance(point, last)));
        chosen.extend((0..points.len()).max_by(|&a, &b| away[a].total_cmp(&away[b])));
    }
    chosen
}
