//! Numbers as files hold them, and back.

use serde_json::{Value, json};

use super::{FileError, FitErrors};
use crate::Rgb;

/// To four digits after the point, as they were fitted.
pub(super) fn number(value: f32) -> f64 {
    (f64::from(value) * 1e4).round() / 1e4
}

/// The same of a colour.
pub(super) fn color(value: Rgb) -> [f64; 3] {
    value.0.map(number)
}

/// The figures of a fit, to six digits after the point.
pub(super) fn errors(errors: &FitErrors) -> Value {
    let round = |value: f64| (value * 1e6).round() / 1e6;
    json!({
        "log_error": round(errors.log_error),
        "relative_log": round(errors.relative_log),
        "studio_psnr": round(errors.studio_psnr),
        "studio_delta_e_itp": round(errors.studio_delta_e_itp),
    })
}

/// The figures in a sentence.
pub(super) fn sentence(errors: &FitErrors) -> String {
    let FitErrors { log_error, studio_psnr, studio_delta_e_itp, .. } = errors;
    format!("log_error {log_error:.4}, studio PSNR {studio_psnr:.1} dB, mean ΔE_ITP {studio_delta_e_itp:.1}")
}

/// Most of what factors and weights may be.
pub(super) const SHARE: [f32; 2] = [0.0, 1.0];
/// An index of refraction.
pub(super) const INDEX: [f32; 2] = [1.0, 100.0];
/// A factor without an upper end, but for one that no material comes near.
pub(super) const FACTOR: [f32; 2] = [0.0, 100.0];

/// A number of an object within a range, or what it is without.
pub(super) fn read_number(object: &Value, name: &str, without: f32, range: [f32; 2]) -> Result<f32, FileError> {
    match &object[name] {
        Value::Null => Ok(without),
        value => channel(value, range).ok_or_else(|| refused("a number", name, range, value)),
    }
}

/// The first three numbers of an array of an object, each within a range, or what they are without.
pub(super) fn read_color(object: &Value, name: &str, without: Rgb, range: [f32; 2]) -> Result<Rgb, FileError> {
    let value = &object[name];
    if value.is_null() {
        return Ok(without);
    }
    let at = |i: usize| channel(&value[i], range).ok_or_else(|| refused("three numbers", name, range, value));
    Ok(Rgb([at(0)?, at(1)?, at(2)?]))
}

/// That something else is there than numbers within a range.
pub(super) fn refused(what: &str, name: &str, [low, high]: [f32; 2], found: impl ToString) -> FileError {
    FileError::new(format!("{what} of {low} to {high} for '{name}'"), found)
}

fn channel(value: &Value, [low, high]: [f32; 2]) -> Option<f32> {
    value.as_f64().map(|number| number as f32).filter(|number| (low..=high).contains(number))
}
