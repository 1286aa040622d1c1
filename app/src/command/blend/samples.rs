//! Where on a path the spheres are.

use anyhow::Result;
use nbrdf_core::Weights;

pub use super::sample::Sample;
use super::sample::{exact, joined, number};
use crate::failure::Failure;

/// Points between two ends unless told otherwise.
const STEPS: u16 = 7;

/// The points asked for: `at`, else `steps` even ones between two ends, else corners, edges and the centre.
pub fn samples(ends: usize, at: &[String], steps: Option<u16>) -> Result<Vec<Sample>> {
    let points = match (at, steps) {
        ([], Some(steps)) if ends > 2 => return Ok(spline(ends, steps)),
        ([], steps) if ends == 2 => even(steps.unwrap_or(STEPS)),
        ([], _) => corners_edges_centre(ends),
        (at, _) => return given(ends, at),
    };
    points.into_iter().map(Sample::spread).collect()
}

/// Even steps on the smooth curve through all key materials.
fn spline(ends: usize, steps: u16) -> Vec<Sample> {
    let last = f32::from(steps.max(2) - 1);
    let one = |i: u16| {
        let t = f32::from(i) / last;
        Sample { weights: Weights::along_spline(t, ends), label: format!("t = {}", number(t)), warning: None }
    };
    (0..steps).map(one).collect()
}

fn even(steps: u16) -> Vec<Vec<f32>> {
    let last = f32::from(steps.max(2) - 1);
    (0..steps).map(|i| f32::from(i) / last).map(|t| vec![1.0 - t, t]).collect()
}

/// Around the polygon, corner and edge by turns, then its centre.
fn corners_edges_centre(ends: usize) -> Vec<Vec<f32>> {
    let among = |chosen: &[usize]| (0..ends).map(|end| f32::from(u8::from(chosen.contains(&end)))).collect();
    let around = (0..ends).flat_map(|end| [among(&[end]), among(&[end, (end + 1) % ends])]);
    around.chain([vec![1.0; ends]]).collect()
}

/// `0.25` is a place between two ends; `1,1,2`, or one number per end, are weights.
fn given(ends: usize, at: &[String]) -> Result<Vec<Sample>> {
    let asked = |weights: &[f32]| Sample::new(weights.to_vec(), joined(weights, exact));
    let (mut points, mut loose) = (Vec::new(), Vec::new());
    for text in at {
        let numbers = text.split(',').map(finite).collect::<Result<Vec<f32>>>()?;
        match numbers.as_slice() {
            [t] if ends == 2 => points.push(Sample::new(vec![1.0 - t, *t], exact(*t))?),
            [weight] => loose.push(*weight),
            weights if weights.len() == ends => points.push(asked(weights)?),
            weights => {
                let found = format!("--at {text}: expected {ends} weights, one per material, found {}", weights.len());
                return Err(Failure::Usage(found).into());
            }
        }
    }
    if !loose.len().is_multiple_of(ends) {
        let found = format!("--at: expected {ends} weights, one per material, found {}", loose.len());
        return Err(Failure::Usage(found).into());
    }
    for weights in loose.chunks(ends) {
        points.push(asked(weights)?);
    }
    Ok(points)
}

fn finite(text: &str) -> Result<f32> {
    let number = text.trim().parse().ok().filter(|number: &f32| number.is_finite());
    number.ok_or_else(|| Failure::Usage(format!("--at {text}: expected a number such as 0.25")).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ends: usize, at: &[&str], steps: Option<u16>) -> Vec<String> {
        let at: Vec<String> = at.iter().map(|text| (*text).to_owned()).collect();
        samples(ends, &at, steps).unwrap().into_iter().map(|sample| sample.label).collect()
    }

    #[test]
    fn two_ends_are_seven_steps_apart_unless_told_otherwise() {
        assert_eq!(labels(2, &[], None), ["0", "0.17", "0.33", "0.5", "0.67", "0.83", "1"]);
        assert_eq!(labels(2, &[], Some(3)), ["0", "0.5", "1"]);
        assert_eq!(labels(2, &["-0.5", "0.25", "-0"], None), ["-0.5", "0.25", "0"]);
    }

    #[test]
    fn a_place_is_called_what_it_was_asked_for_as() {
        assert_eq!(labels(2, &["0.125", "3,1"], None), ["0.125", "3 : 1"]);
        assert_eq!(labels(3, &["1,1,2", "0.0625,0,0.9375"], None), ["1 : 1 : 2", "0.0625 : 0 : 0.9375"]);
        let heading = |at: &str| samples(2, &[at.to_owned()], None).unwrap()[0].heading();
        assert_eq!([heading("0.125"), heading("3,1")], ["t = 0.125", "3 : 1"]);
    }

    #[test]
    fn three_ends_show_corners_edges_and_the_centre() {
        let shown = labels(3, &[], None);
        assert_eq!(shown.len(), 7);
        assert_eq!((shown[0].as_str(), shown[1].as_str()), ("1 : 0 : 0", "0.5 : 0.5 : 0"));
        assert_eq!(labels(3, &["0.2", "0.3", "0.5"], None), labels(3, &["0.2,0.3,0.5"], None));
    }

    #[test]
    fn steps_through_more_than_two_materials_pass_each_of_them() {
        let shown = samples(3, &[], Some(5)).unwrap();
        let one_hot = [(0, 0), (2, 1), (4, 2)];
        assert!(one_hot.iter().all(|&(step, end)| (shown[step].weights.as_slice()[end] - 1.0).abs() < 1e-5));
        assert_eq!((shown[1].label.as_str(), shown[1].warning.as_ref()), ("t = 0.25", None));
    }

    #[test]
    fn points_that_make_no_sense_are_usage_errors() {
        for (ends, at) in [(2, "x"), (2, "nan"), (2, "1,2,3"), (3, "0.5"), (3, "1,1"), (2, "1,-1")] {
            let error = samples(ends, &[at.to_owned()], None).unwrap_err();
            assert_eq!(crate::failure::exit_code(&error), 2, "{at}");
        }
    }

    #[test]
    fn what_lies_beyond_the_ends_is_known() {
        let beyond = |t: &str| samples(2, &[t.to_owned()], None).unwrap()[0].warning.is_some();
        assert!(beyond("-0.1") && beyond("1.5") && !beyond("0") && !beyond("1"));
    }
}
