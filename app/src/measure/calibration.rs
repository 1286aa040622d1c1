//! Whether what a code was expected to be worth is what it turns out to be worth.

use nbrdf_core::metric::Spread;
use serde::Serialize;

/// Expectation and truth over many materials.
#[derive(Debug, Serialize)]
pub struct Calibration {
    /// Representation.
    pub name: String,
    /// How its codes are made.
    pub variant: String,
    /// Materials, of all databases together.
    pub count: usize,
    /// Rank correlation of expected and true `log_error`, −1..1.
    pub spearman_expected: f64,
    /// Rank correlation of the distance to known materials and the true `log_error`; none where there is no distance.
    pub spearman_distance: Option<f64>,
    /// True over expected error: 1 where the expectation is exact.
    pub ratio: Option<Spread>,
}

/// One material: its name, what was expected, how far it is from known ones, and the true error.
pub struct Judged {
    /// Name.
    pub material: String,
    /// Expected `log_error`.
    pub expected: f64,
    /// Distance to known materials.
    pub distance: Option<f64>,
    /// True `log_error`.
    pub truth: f64,
}

impl Calibration {
    /// Of one representation's materials.
    pub fn of(name: &str, variant: &str, judged: &[Judged]) -> Self {
        let truth: Vec<f64> = judged.iter().map(|one| one.truth).collect();
        let expected: Vec<f64> = judged.iter().map(|one| one.expected).collect();
        let distances: Option<Vec<f64>> = judged.iter().map(|one| one.distance).collect();
        let ratio = judged.iter().map(|one| (one.material.as_str(), one.truth / one.expected));
        Self {
            name: name.into(),
            variant: variant.into(),
            count: judged.len(),
            spearman_expected: spearman(&expected, &truth),
            spearman_distance: distances.map(|distances| spearman(&distances, &truth)),
            ratio: Spread::new(ratio, false),
        }
    }
}

/// Spearman's rank correlation; ties share their mean rank. 0 where one side does not vary.
pub fn spearman(a: &[f64], b: &[f64]) -> f64 {
    let [a, b] = [ranks(a), ranks(b)];
    let mean = (a.len() as f64 - 1.0) / 2.0;
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum::<f64>();
    let scale = (product(&a, &a) * product(&b, &b)).sqrt();
    if scale > 0.0 { product(&a, &b) / scale } else { 0.0 }
}

fn ranks(values: &[f64]) -> Vec<f64> {
    let below = |v: f64| values.iter().filter(|other| other.total_cmp(&v).is_lt()).count();
    let same = |v: f64| values.iter().filter(|other| other.total_cmp(&v).is_eq()).count();
    values.iter().map(|&v| below(v) as f64 + (same(v) as f64 - 1.0) / 2.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_decide_and_values_do_not() {
        let a = [1.0, 2.0, 3.0, 4.0];
        assert!((spearman(&a, &[1.0, 10.0, 11.0, 1e6]) - 1.0).abs() < 1e-12);
        assert!((spearman(&a, &[4.0, 3.0, 2.0, 1.0]) + 1.0).abs() < 1e-12);
        assert_eq!(spearman(&a, &[5.0; 4]), 0.0);
    }

    /// scipy.stats.spearmanr([1, 2, 2, 3, 7], [2, 1, 4, 4, 9]).statistic
    #[test]
    fn ties_are_those_of_scipy() {
        let found = spearman(&[1.0, 2.0, 2.0, 3.0, 7.0], &[2.0, 1.0, 4.0, 4.0, 9.0]);
        assert!((found - 0.763_157_894_736_842).abs() < 1e-12, "{found}");
    }
}
