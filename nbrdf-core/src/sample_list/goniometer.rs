//! The text of the Cornell goniometer.

use std::f64::consts::FRAC_PI_2;

use super::{SampleList, SampleListError, numbers, problem};
use crate::Directions;
use crate::spectrum::{Illuminant, Observer};

/// More wavelengths are no spectrum.
const MOST_WAVELENGTHS: usize = 4096;
/// Angles before the reflectances.
const ANGLES: usize = 4;

pub(super) fn parse(text: &str) -> Result<SampleList, SampleListError> {
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let mut next = || lines.find(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let end = text.lines().count();
    let Some((line, field)) = next() else { return Err(problem(end, "the number of wavelengths", "the end".into())) };
    let count = field.parse::<usize>().ok().filter(|count| (2..=MOST_WAVELENGTHS).contains(count));
    let Some(count) = count else {
        let found = format!("'{}'", field.chars().take(40).collect::<String>());
        return Err(problem(line, &format!("the number of wavelengths, 2 to {MOST_WAVELENGTHS}"), found));
    };
    let mut wavelengths = Vec::with_capacity(count);
    while wavelengths.len() < count {
        let expected = format!("{count} wavelengths");
        let Some((line, text)) = next() else { return Err(problem(end, &expected, wavelengths.len().to_string())) };
        wavelengths.extend(numbers(line, &text.split_whitespace().collect::<Vec<_>>())?);
        let rises = wavelengths.windows(2).all(|pair| pair[0] < pair[1]);
        let fits = wavelengths.iter().all(|nm| (200.0..=3000.0).contains(nm));
        if wavelengths.len() > count || !rises || !fits {
            return Err(problem(
                line,
                &format!("{expected} that rise, in nm"),
                format!("{} that end with {:?}", wavelengths.len(), wavelengths.last()),
            ));
        }
    }
    let (first, last) = (wavelengths[0], wavelengths[count - 1]);
    let observer = Observer::new(&wavelengths, Illuminant::D65)
        .ok_or_else(|| problem(end, "wavelengths over the visible, 400 to 700 nm", format!("{first} to {last}")))?;
    let mut list = SampleList::default();
    while let Some((line, text)) = next() {
        let fields: Vec<&str> = text.split_whitespace().collect();
        if fields.len() != ANGLES + count {
            let expected = format!("{ANGLES} angles and {count} reflectances");
            return Err(problem(line, &expected, format!("{} numbers", fields.len())));
        }
        let values = numbers(line, &fields)?;
        let (angles, spectrum) = values.split_at(ANGLES);
        // A little more than the quarter turn is rounding.
        if let Some(angle) = [angles[0], angles[2]].into_iter().find(|angle| !(0.0..FRAC_PI_2 + 0.01).contains(angle)) {
            let found = format!("{angle}: are these degrees?");
            return Err(problem(line, "polar angles of 0 to pi/2 radians", found));
        }
        let [theta_i, phi_i, theta_o, phi_o] = [0, 1, 2, 3].map(|i| angles[i] as f32);
        let at = Directions::from_angles(theta_i, phi_i, theta_o, phi_o);
        list.push(at, observer.rgb(spectrum.iter().copied()));
    }
    list.not_empty()
}
