//! Which charts a point belongs to.
//!
//! M. Brand, *Charting a Manifold*, section 4: p_k(y) ∝ N(y; μ_k, Σ_k), those that are vanishingly small set to zero: charts
//! that only seem near, as those of the next turn of a roll, would bend the connection. Differs: where so few charts share
//! a point that they cannot be connected (in many dimensions a Gaussian density is all or nothing), densities are taken
//! to the power 1 / temperature, the least at which the points are shared by as many charts as asked for.

/// What counts as vanishingly small beside the largest; where a weight falls to it, it has faded to zero.
const VANISHING: f64 = 1e-3;

/// p_k from logarithms of densities; sums to 1, however far all charts are away.
pub(super) fn posterior(log_densities: &[f64], temperature: f64) -> Vec<f64> {
    let largest = log_densities.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let faded = |l: &f64| (((l - largest) / temperature).exp() - VANISHING).max(0.0);
    let mut weights: Vec<f64> = log_densities.iter().map(faded).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|w| *w /= sum);
    weights
}

/// The least temperature ≥ 1 at which the points (rows) are shared by `charts` charts on average, in the sense of the
/// entropy's exponential; by at most half of all charts.
pub(super) fn temperature(log_densities: &[Vec<f64>], charts: f64) -> f64 {
    let wanted = charts.min(0.5 * log_densities.first().map_or(0, Vec::len) as f64);
    let sharing = |log_temperature: f64| {
        let of = |row: &Vec<f64>| perplexity(&posterior(row, log_temperature.exp()));
        log_densities.iter().map(of).sum::<f64>() / log_densities.len() as f64
    };
    let (mut low, mut high) = (0.0, 20.0);
    if sharing(low) >= wanted {
        return 1.0;
    }
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if sharing(middle) >= wanted { high = middle } else { low = middle }
    }
    high.exp()
}

fn perplexity(weights: &[f64]) -> f64 {
    weights.iter().filter(|w| **w > 0.0).map(|w| -w * w.ln()).sum::<f64>().exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_add_up_to_one_also_where_every_density_is_nothing() {
        let weights = posterior(&[-1e9, -1e9 - 1.0, -2e9], 1.0);
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!((weights[0] / weights[1] - std::f64::consts::E).abs() < 0.01 && weights[2] == 0.0);
    }

    #[test]
    fn the_temperature_is_one_where_charts_overlap_and_just_high_enough_where_they_do_not() {
        let rows: Vec<Vec<f64>> =
            (0..20).map(|i: i32| (0..20).map(|k: i32| -f64::from((i - k).pow(2))).collect()).collect();
        assert_eq!(temperature(&rows, 1.5), 1.0);
        let found = temperature(&rows, 6.0);
        let mean = rows.iter().map(|row| perplexity(&posterior(row, found))).sum::<f64>() / 20.0;
        assert!(found > 1.0 && (mean - 6.0).abs() < 1e-6, "{found} {mean}");
    }
}
