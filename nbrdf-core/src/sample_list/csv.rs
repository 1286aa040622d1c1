//! Comma-separated samples.

use super::{SampleList, SampleListError, numbers, problem};
use crate::{Directions, Rgb, Vec3};

/// The heading.
const COLUMNS: &str = "light_x,light_y,light_z,view_x,view_y,view_z,r,g,b";
/// How far from 1 the length of a direction may be.
const LENGTH: f32 = 1e-2;

pub(super) fn parse(text: &str) -> Result<SampleList, SampleListError> {
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim()));
    let heading = lines.next().map(|(_, line)| line.replace(' ', "")).unwrap_or_default();
    if heading.trim_start_matches('\u{feff}') != COLUMNS {
        let found = format!("'{}'", heading.chars().take(80).collect::<String>());
        return Err(problem(1, &format!("the heading {COLUMNS}"), found));
    }
    let mut list = SampleList::default();
    for (line, text) in lines.filter(|(_, line)| !line.is_empty()) {
        let fields: Vec<&str> = text.split(',').collect();
        if fields.len() != 9 {
            return Err(problem(line, "9 numbers", fields.len().to_string()));
        }
        let values = numbers(line, &fields)?;
        let [light, view, rgb] = [0, 3, 6].map(|from| [0, 1, 2].map(|i| values[from + i] as f32));
        let [light, view] = [light, view].map(Vec3::from_array);
        if let Some(odd) = [light, view].into_iter().find(|v| (v.length() - 1.0).abs() > LENGTH) {
            return Err(problem(line, "unit vectors", format!("one of length {}", odd.length())));
        }
        if let Some(negative) = rgb.into_iter().find(|&f| f < 0.0) {
            return Err(problem(line, "reflectances of 0 and more", negative.to_string()));
        }
        list.push(Directions::new(light.normalize(), view.normalize()), Rgb(rgb));
    }
    list.not_empty()
}
