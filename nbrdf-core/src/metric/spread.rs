//! How a figure is spread over many materials: never a mean alone.

use serde::{Deserialize, Serialize};

/// How many names [`Spread::worst`] holds at most.
const WORST: usize = 5;

/// Mean, median, the bad tail, and who is in it.
///
/// The tail points to the bad side: where higher is better (PSNR, SSIM), `p90` is the value that nine in ten
/// materials reach or exceed (the 10th percentile from below), and `max` is the *lowest* value. NaN is worst of all.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Arithmetic mean.
    pub mean: f64,
    /// Half the materials are better.
    pub median: f64,
    /// Nine in ten materials are better.
    pub p90: f64,
    /// The worst value.
    pub max: f64,
    /// Names of the five worst, the worst first; ties by name.
    pub worst: Vec<String>,
}

impl Spread {
    /// Of named values; `None` if there are none. Percentiles are interpolated linearly between ranks.
    pub fn new<N: Into<String>>(values: impl IntoIterator<Item = (N, f64)>, higher_is_better: bool) -> Option<Self> {
        let badness = |value| badness(value, higher_is_better);
        let mut named: Vec<(String, f64)> = values.into_iter().map(|(name, value)| (name.into(), value)).collect();
        // Worst last by value, then by name backwards, so that the reversed list starts with the worst in order.
        named.sort_by(|a, b| badness(a.1).total_cmp(&badness(b.1)).then_with(|| b.0.cmp(&a.0)));
        let max = named.last()?.1;
        let sum: f64 = named.iter().map(|(_, value)| value).sum();
        Some(Self {
            mean: sum / named.len() as f64,
            median: percentile(&named, 0.5),
            p90: percentile(&named, 0.9),
            max,
            worst: named.iter().rev().take(WORST).map(|(name, _)| name.clone()).collect(),
        })
    }
}

/// Grows as a figure gets worse, by `total_cmp`; NaN is worst of all.
pub fn badness(value: f64, higher_is_better: bool) -> f64 {
    if value.is_nan() {
        f64::NAN
    } else if higher_is_better {
        -value
    } else {
        value
    }
}

/// At `share` of the way from the best to the worst rank.
fn percentile(sorted: &[(String, f64)], share: f64) -> f64 {
    let rank = share * (sorted.len() - 1) as f64;
    let (below, above) = (sorted[rank.floor() as usize].1, sorted[rank.ceil() as usize].1);
    // Equal ranks may hold infinities, whose difference would be NaN.
    if below == above { below } else { below + rank.fract() * (above - below) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn to_ten() -> Vec<(String, f64)> {
        (0..=10).map(|i| (format!("m{i:02}"), f64::from(i))).collect()
    }

    #[test]
    fn low_figures_have_their_tail_at_the_top() {
        let spread = Spread::new(to_ten(), false).unwrap();
        assert_eq!((spread.mean, spread.median, spread.p90, spread.max), (5.0, 5.0, 9.0, 10.0));
        assert_eq!(spread.worst, ["m10", "m09", "m08", "m07", "m06"]);
    }

    #[test]
    fn high_figures_have_their_tail_at_the_bottom() {
        let spread = Spread::new(to_ten(), true).unwrap();
        assert_eq!((spread.mean, spread.median, spread.p90, spread.max), (5.0, 5.0, 1.0, 0.0));
        assert_eq!(spread.worst, ["m00", "m01", "m02", "m03", "m04"]);
    }

    #[test]
    fn ranks_are_interpolated() {
        let spread = Spread::new([("a", 0.0), ("b", 1.0)], false).unwrap();
        assert_eq!((spread.median, spread.p90), (0.5, 0.9));
    }

    #[test]
    fn nothing_has_no_spread() {
        assert!(Spread::new(Vec::<(String, f64)>::new(), false).is_none());
    }

    #[test]
    fn nan_is_the_worst_either_way_and_ties_go_by_name() {
        for higher_is_better in [false, true] {
            let values = [("b", 1.0), ("nan", f64::NAN), ("a", 1.0)];
            let spread = Spread::new(values, higher_is_better).unwrap();
            assert_eq!(spread.worst, ["nan", "a", "b"]);
            assert!(spread.max.is_nan());
        }
    }
}
