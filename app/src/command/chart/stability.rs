//! Whether every run finds the same models worth their time.

use std::fmt;

use super::saved::Saved;

/// The fronts of all runs; near ties are decided by the medians.
pub struct Stability {
    /// Names of the models on each, by rising time.
    pub fronts: Vec<Vec<String>>,
}

impl Stability {
    /// Of a report, by this error.
    pub fn of(saved: &Saved, metric: &str) -> Self {
        let titles = |run| saved.front_of_run(metric, run).into_iter().map(|i| saved.points[i].title()).collect();
        Self { fronts: (0..saved.runs).map(titles).collect() }
    }

    /// Whether all are of the same models.
    pub fn is_stable(&self) -> bool {
        self.changing().is_empty()
    }

    /// Models that are on some fronts and not on others, with how often they are.
    fn changing(&self) -> Vec<(&str, usize)> {
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for title in self.fronts.iter().flatten() {
            match counts.iter_mut().find(|(known, _)| known == title) {
                Some((_, count)) => *count += 1,
                None => counts.push((title, 1)),
            }
        }
        counts.retain(|&(_, count)| count < self.fronts.len());
        counts
    }
}

impl fmt::Display for Stability {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let runs = self.fronts.len();
        let changing: Vec<String> =
            self.changing().into_iter().map(|(title, count)| format!("{title} ({count} of {runs})")).collect();
        match changing.as_slice() {
            _ if runs < 2 => write!(f, "one run"),
            [] => write!(f, "{runs} runs: the same front in each, near ties decided by the medians"),
            some => write!(f, "{runs} runs: not on the front of each: {}", some.join(", ")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stability(fronts: &[&[&str]]) -> Stability {
        Stability { fronts: fronts.iter().map(|front| front.iter().map(|&title| title.to_owned()).collect()).collect() }
    }

    #[test]
    fn what_comes_and_goes_is_named_whatever_the_order() {
        let stable = stability(&[&["a", "b"], &["b", "a"]]);
        assert!(stable.is_stable());
        assert_eq!(stable.to_string(), "2 runs: the same front in each, near ties decided by the medians");
        let changing = stability(&[&["a", "b"], &["a"], &["a", "c", "b"]]);
        assert!(!changing.is_stable());
        assert_eq!(changing.to_string(), "3 runs: not on the front of each: b (2 of 3), c (1 of 3)");
        assert_eq!(stability(&[&["a"]]).to_string(), "one run");
    }
}
