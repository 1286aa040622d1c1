//! Unconstrained numbers for parameters that have a range, both ways.

/// exp of more is no parameter of any material.
const LARGEST_LOGARITHM: f32 = 40.0;

/// A parameter above 0 from its logarithm.
pub(crate) fn positive(number: f32) -> f32 {
    number.clamp(-LARGEST_LOGARITHM, LARGEST_LOGARITHM).exp()
}

/// Three parameters above 0 from their logarithms.
pub(crate) fn positive_rgb(numbers: &[f32]) -> crate::Rgb {
    crate::Rgb([positive(numbers[0]), positive(numbers[1]), positive(numbers[2])])
}

/// The logarithm of a parameter; of 0, that of very little.
pub(crate) fn of_positive(value: f32) -> f32 {
    value.max(1e-6).ln()
}

/// A parameter in a range from the logit of its place there.
pub(crate) fn between(number: f32, [low, high]: [f32; 2]) -> f32 {
    low + (high - low) / (1.0 + (-number).exp())
}

/// The logit of a parameter's place in a range; at the ends, that of a place near them.
pub(crate) fn of_between(value: f32, [low, high]: [f32; 2]) -> f32 {
    let place = ((value - low) / (high - low)).clamp(1e-4, 1.0 - 1e-4);
    (place / (1.0 - place)).ln()
}

/// A parameter above 0 in a range from the logit of its logarithm's place there.
pub(crate) fn log_between(number: f32, range: [f32; 2]) -> f32 {
    between(number, range.map(f32::ln)).exp()
}

/// The inverse of [`log_between`].
pub(crate) fn of_log_between(value: f32, range: [f32; 2]) -> f32 {
    of_between(value.ln(), range.map(f32::ln))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_come_back_and_stay_in_their_ranges() {
        for value in [0.011, 0.3, 0.99] {
            let range = [0.01, 1.0];
            assert!((positive(of_positive(value)) / value - 1.0).abs() < 1e-5);
            assert!((between(of_between(value, range), range) / value - 1.0).abs() < 1e-4);
            assert!((log_between(of_log_between(value, range), range) / value - 1.0).abs() < 1e-4);
        }
        for number in [-f32::MAX, -1e3, 0.0, 1e3, f32::MAX] {
            assert!((2.0..=3.0).contains(&between(number, [2.0, 3.0])), "{number}");
            assert!(positive(number) > 0.0 && positive(number).is_finite(), "{number}");
        }
    }
}
