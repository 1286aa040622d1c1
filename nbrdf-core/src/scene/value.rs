//! Values of a scene's file, checked.

use glam::DVec3;

use super::SceneProblem;
use super::keys::Vector;
use crate::Rgb;

/// Largest coordinate.
pub(super) const LARGEST: f64 = 1e6;
/// Smallest size.
pub(super) const SMALLEST: f64 = 1e-6;
/// Largest radiance and intensity.
const BRIGHTEST: f64 = 1e9;

pub(super) fn within(place: &str, value: f64, low: f64, high: f64) -> Result<f64, SceneProblem> {
    match value >= low && value <= high {
        true => Ok(value),
        false => Err(SceneProblem::value(place, format!("{low} to {high}"), value)),
    }
}

/// Above 0.
pub(super) fn positive(place: &str, value: f64, high: f64) -> Result<f64, SceneProblem> {
    let refused = |_| SceneProblem::value(place, format!("above 0, {high} at most"), value);
    within(place, value, f64::MIN_POSITIVE, high).map_err(refused)
}

pub(super) fn place(name: &str, value: Vector) -> Result<DVec3, SceneProblem> {
    match value.iter().find(|v| !(-LARGEST..=LARGEST).contains(*v)) {
        Some(v) => Err(SceneProblem::value(name, format!("numbers within {LARGEST:e}"), v)),
        None => Ok(DVec3::from_array(value)),
    }
}

pub(super) fn unit(name: &str, value: Vector) -> Result<DVec3, SceneProblem> {
    let found = place(name, value)?.try_normalize();
    found.ok_or_else(|| SceneProblem::value(name, "a direction", format!("{value:?}")))
}

pub(super) fn rectangle(
    name: &str,
    centre: Vector,
    u: Vector,
    v: Vector,
) -> Result<(DVec3, DVec3, DVec3), SceneProblem> {
    let centre = place(&format!("{name}, centre"), centre)?;
    let (u, v) = (place(&format!("{name}, u"), u)?, place(&format!("{name}, v"), v)?);
    let is_edge = |edge: DVec3| edge.length() >= SMALLEST;
    if !is_edge(u) || !is_edge(v) || u.normalize().dot(v.normalize()).abs() > 1e-6 {
        return Err(SceneProblem::value(name, "half edges u and v at a right angle", format!("{u} and {v}")));
    }
    Ok((centre, u, v))
}

pub(super) fn bright(name: &str, value: Vector) -> Result<Rgb, SceneProblem> {
    match value.iter().find(|v| !(0.0..=BRIGHTEST).contains(*v)) {
        Some(v) => Err(SceneProblem::value(name, format!("0 to {BRIGHTEST:e}"), v)),
        None => Ok(Rgb(value.map(|v| v as f32))),
    }
}
