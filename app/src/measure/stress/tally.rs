//! Examples of one method under one hazard, of which the worst is kept.

use std::sync::Arc;

use nbrdf_core::stress::{Hazard, Verdict};
use nbrdf_core::{Brdf, Warning};

use super::cell::{Cell, Threshold};
use super::picture::{self, View};

/// Names of the worst that are kept.
const WORST: usize = 3;

/// What an example looks like.
pub struct Look {
    /// Reflectances beside each other, each with its label: what should be, then what is; or ends and middle.
    pub panels: Vec<(String, Arc<dyn Brdf>)>,
    /// How they are looked at.
    pub view: View,
}

/// How much worse; no better than nothing, and what is no number stays none.
pub fn worse_by(difference: f64) -> f64 {
    if difference.is_nan() { difference } else { difference.max(0.0) }
}

/// All examples of a cell.
pub struct Tally<'a> {
    hazard: &'a Hazard,
    values: Vec<(String, f64)>,
    refused: Vec<String>,
    worst: Option<(f64, Look, Vec<Warning>)>,
}

impl<'a> Tally<'a> {
    pub const fn new(hazard: &'a Hazard) -> Self {
        Self { hazard, values: Vec::new(), refused: Vec::new(), worst: None }
    }

    /// Adds an example that was answered with an error.
    pub fn refuse(&mut self, name: &str, error: &str) {
        self.refused.push(format!("{name}: {error}"));
    }

    /// Adds an example; `look` is asked only of the worst so far, and then also for what the library says of it.
    pub fn add(&mut self, name: &str, value: f64, look: impl FnOnce() -> (Look, Vec<Warning>)) {
        // What is no number is worst.
        let badness = if value.is_nan() { f64::INFINITY } else { value };
        if self.worst.as_ref().is_none_or(|(worst, ..)| badness > *worst) {
            let (look, warnings) = look();
            self.worst = Some((badness, look, warnings));
        }
        self.values.push((name.to_owned(), badness));
    }

    /// The cell; none of no examples.
    pub fn cell(mut self, method: &str, variant: Option<&str>) -> Option<Cell> {
        // Stable: of equals, the first is the one whose look was kept.
        self.values.sort_by(|a, b| b.1.total_cmp(&a.1));
        let refused = self.refused.len();
        let count = self.values.len() + refused;
        let hazard = self.hazard;
        let (value, verdict) = match self.values.first() {
            Some(&(_, value)) => (Some(value).filter(|value| value.is_finite()), hazard.verdict(value)),
            None if count == 0 => return None,
            None => (None, Verdict::Refuses),
        };
        let bad = self.values.iter().filter(|(_, value)| hazard.verdict(*value) != Verdict::Holds).count();
        let (picture, warnings) = match self.worst {
            Some((_, look, warnings)) => (picture::base64(&look), warnings),
            None => (None, Vec::new()),
        };
        let mut kinds: Vec<String> = warnings.iter().map(|warning| warning.kind().to_owned()).collect();
        kinds.dedup();
        Some(Cell {
            hazard: hazard.name.to_owned(),
            group: hazard.group,
            method: method.to_owned(),
            variant: variant.map(str::to_owned),
            value,
            threshold: Threshold::of(hazard),
            verdict,
            count,
            share: bad as f64 / (count - refused).max(1) as f64,
            worst: self.values.into_iter().map(|(name, _)| name).take(WORST).collect(),
            warnings: kinds,
            note: self.refused.into_iter().next(),
            picture,
        })
    }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::stress::numbers::constants;

    use super::*;

    const HAZARD: Hazard = nbrdf_core::stress::numbers::CONSTANT;

    fn cell(values: &[Result<f64, String>]) -> Option<Cell> {
        let mut tally = Tally::new(&HAZARD);
        for (index, value) in values.iter().enumerate() {
            let look = || Look {
                panels: constants().map(|(name, brdf)| (name.to_owned(), Arc::new(brdf) as Arc<dyn Brdf>)).into(),
                view: View::Studio,
            };
            let warnings = vec![Warning::Extrapolated { beyond: index as f32 }];
            match value {
                Ok(value) => tally.add(&index.to_string(), *value, || (look(), warnings)),
                Err(error) => tally.refuse(&index.to_string(), error),
            }
        }
        tally.cell("m", None)
    }

    #[test]
    fn the_worst_example_speaks_for_a_cell() {
        let found = cell(&[Ok(0.0), Ok(1.0), Ok(1e-9), Ok(0.5)]).unwrap();
        assert_eq!((found.value, found.verdict, found.share), (Some(1.0), Verdict::Fails, 0.5));
        assert_eq!(
            (found.worst, found.warnings),
            (vec!["1".into(), "3".into(), "2".into()], vec!["extrapolated".into()])
        );
        assert!(found.picture.is_some());
    }

    #[test]
    fn no_number_is_no_improvement() {
        assert!(worse_by(f64::NAN).is_nan() && worse_by(-1.0) == 0.0 && worse_by(2.0) == 2.0);
    }

    #[test]
    fn refusing_is_no_failing_and_no_number_is() {
        let refused = || Err("no".to_owned());
        assert!(cell(&[]).is_none());
        let found = cell(&[refused()]).unwrap();
        assert_eq!((found.verdict, found.note, found.value), (Verdict::Refuses, Some("0: no".into()), None));
        assert_eq!(cell(&[refused(), Ok(0.0)]).unwrap().verdict, Verdict::Holds);
        let found = cell(&[Ok(f64::NAN), Ok(0.0)]).unwrap();
        assert_eq!((found.verdict, found.value), (Verdict::Fails, None));
    }
}
