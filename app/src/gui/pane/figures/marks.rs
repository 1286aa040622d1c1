//! Round numbers along the axes of a plot.

use egui_plot::{GridInput, GridMark};

/// Least distances of marks: 80 and 30 points, in the plot's smallest steps of 8. Closer ones have no room for numbers.
pub const ACROSS: f64 = 10.0;
pub const UP: f64 = 3.75;

/// Marks at 1, 2 or 5 times a power of ten, `apart` smallest steps or more from each other, and `least` at least.
pub fn round(apart: f64, least: f64) -> impl Fn(GridInput) -> Vec<GridMark> {
    move |input| {
        let wanted = (apart * input.base_step_size).max(least);
        let power = 10f64.powf(wanted.log10().floor());
        let step_size = power * [1.0, 2.0, 5.0].into_iter().find(|times| times * power >= wanted).unwrap_or(10.0);
        let (low, high) = ((input.bounds.0 / step_size).ceil(), (input.bounds.1 / step_size).floor());
        if !(high - low).is_finite() {
            return Vec::new();
        }
        let count = (high - low + 1.0).max(0.0) as u32;
        (0..count).map(|mark| GridMark { value: (low + f64::from(mark)) * step_size, step_size }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_within_the_axis() {
        let of = |bounds, base_step_size, least| -> Vec<f64> {
            let marks = round(4.0, least)(GridInput { bounds, base_step_size });
            marks.iter().map(|mark| mark.value).collect()
        };
        assert_eq!(of((-1.0, 62.0), 4.0, 0.0), [0.0, 20.0, 40.0, 60.0]);
        assert_eq!(of((-0.5, 1.5), 0.125, 0.0), [-0.5, 0.0, 0.5, 1.0, 1.5]);
        assert_eq!(of((-2.5, 1.0), 0.05, 1.0), [-2.0, -1.0, 0.0, 1.0], "powers of ten have no halves");
        assert!(of((f64::NAN, 1.0), 0.1, 0.0).is_empty());
    }
}
