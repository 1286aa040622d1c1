//! `length_ratio`, `step_ratio`, `hue_excursion`: how a path from one material to another looks, t = 0 to 1.

use serde::{Deserialize, Serialize};

use super::ItpImage;
use crate::{Image, Rgb, image::clipped};

/// Linear BT.709 → XYZ (IEC 61966-2-1, derived from the primaries and D65).
const XYZ_FROM_BT709: [[f64; 3]; 3] = [
    [0.412_390_799_265_960, 0.357_584_339_383_878, 0.180_480_788_401_834],
    [0.212_639_005_871_510, 0.715_168_678_767_756, 0.072_192_315_360_734],
    [0.019_330_818_715_592, 0.119_194_779_794_626, 0.950_532_152_249_661],
];

/// The three figures of one path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Smoothness {
    /// Sum of ΔE_ITP between neighbours / ΔE_ITP of the ends; 1 is straight. Infinite for a loop, 1 at rest.
    pub length_ratio: f64,
    /// Largest step / mean step in ΔE_ITP; 1 is even scrubbing, also at rest.
    pub step_ratio: f64,
    /// See [`hue_excursion`].
    pub hue_excursion: f64,
}

impl Smoothness {
    /// Of the *linear* pictures along a path, in order, ends included.
    ///
    /// # Panics
    /// If there are fewer than two pictures, or their sizes or the mask's differ (a bug of the caller).
    pub fn of(images: &[Image], covered: &[bool]) -> Self {
        assert!(images.len() >= 2, "a path has two ends");
        let seen: Vec<ItpImage> = images.iter().map(ItpImage::new).collect();
        let steps: Vec<f64> = seen.windows(2).map(|pair| pair[0].distance(&pair[1], covered)).collect();
        let ends = seen[0].distance(&seen[seen.len() - 1], covered);
        let length: f64 = steps.iter().sum();
        let largest = steps.iter().copied().fold(0.0, f64::max);
        let or_at_rest = |ratio: f64| if length > 0.0 { ratio } else { 1.0 };
        Self {
            length_ratio: or_at_rest(length / ends),
            step_ratio: or_at_rest(largest / (length / steps.len() as f64)),
            hue_excursion: hue_excursion(images, covered),
        }
    }
}

/// Largest distance in u′v′ of the pictures' mean colours from the segment between the ends'; 0 for no detour.
///
/// # Panics
/// If the mask differs in size from a picture (a bug of the caller).
pub fn hue_excursion(images: &[Image], covered: &[bool]) -> f64 {
    let colours: Vec<[f64; 2]> = images.iter().map(|image| mean_chromaticity(image, 1.0, covered)).collect();
    let (Some(&first), Some(&last)) = (colours.first(), colours.last()) else { return 0.0 };
    colours.iter().map(|&colour| distance_from_segment(colour, first, last)).fold(0.0, f64::max)
}

/// CIE 1976 u′v′ of the mean over covered pixels of a *linear* picture times `gain`, clipped to 0..1. A black picture
/// counts as white light.
///
/// # Panics
/// If the mask differs in size from the picture (a bug of the caller).
pub fn mean_chromaticity(image: &Image, gain: f32, covered: &[bool]) -> [f64; 2] {
    assert_eq!(image.pixels().len(), covered.len(), "one mask entry per pixel");
    let (mut sum, mut count) = ([0.0; 3], 0_usize);
    for (Rgb(pixel), _) in image.pixels().iter().zip(covered).filter(|&(_, &on)| on) {
        for (sum, value) in sum.iter_mut().zip(pixel) {
            *sum += f64::from(clipped(gain * value));
        }
        count += 1;
    }
    chromaticity(sum.map(|sum| sum / count.max(1) as f64))
}

/// CIE 1976 u′v′ of linear BT.709.
fn chromaticity(linear: [f64; 3]) -> [f64; 2] {
    let linear = if linear == [0.0; 3] { [1.0; 3] } else { linear };
    let [x, y, z] = XYZ_FROM_BT709.map(|row| row.iter().zip(linear).map(|(m, v)| m * v).sum::<f64>());
    let scale = x + 15.0 * y + 3.0 * z;
    [4.0 * x / scale, 9.0 * y / scale]
}

/// CIE 1976 u′v′ of linear BT.709, and how it moves with the channels: row by row, ∂(u′, v′)/∂channel. Black counts as white.
pub fn chromaticity_and_slopes(linear: [f64; 3]) -> ([f64; 2], [[f64; 2]; 3]) {
    let colour = chromaticity(linear);
    if linear == [0.0; 3] {
        return (colour, [[0.0; 2]; 3]);
    }
    let [x, y, z] = XYZ_FROM_BT709.map(|row| row.iter().zip(linear).map(|(m, v)| m * v).sum::<f64>());
    let scale = x + 15.0 * y + 3.0 * z;
    let by_channel = |channel: usize| {
        let [x, y, z] = XYZ_FROM_BT709.map(|row| row[channel]);
        let moved = x + 15.0 * y + 3.0 * z;
        [(4.0 * x - colour[0] * moved) / scale, (9.0 * y - colour[1] * moved) / scale]
    };
    (colour, [0, 1, 2].map(by_channel))
}

/// From the nearest point of the segment between two others to `point`.
pub fn detour(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let [along, offset] = [to, point].map(|end| [end[0] - from[0], end[1] - from[1]]);
    let share = share_along(along, offset).clamp(0.0, 1.0);
    [offset[0] - share * along[0], offset[1] - share * along[1]]
}

/// The part of a small change of `point` that changes its [`detour`]: across the segment where the nearest point lies
/// within, all of it where that is an end.
pub fn change_of_detour(point: [f64; 2], from: [f64; 2], to: [f64; 2], change: [f64; 2]) -> [f64; 2] {
    let [along, offset] = [to, point].map(|end| [end[0] - from[0], end[1] - from[1]]);
    let share = share_along(along, offset);
    let lengthwise = if share > 0.0 && share < 1.0 { share_along(along, change) } else { 0.0 };
    [change[0] - lengthwise * along[0], change[1] - lengthwise * along[1]]
}

/// How much of `along` lies in `v`; nothing where `along` has no length.
fn share_along(along: [f64; 2], v: [f64; 2]) -> f64 {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let length2 = dot(along, along);
    if length2 > 0.0 { dot(along, v) / length2 } else { 0.0 }
}

/// Distance of a point from the segment between two others, in their unit.
pub fn distance_from_segment(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let [u, v] = detour(point, from, to);
    u.hypot(v)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(colours: &[[f32; 3]]) -> Vec<Image> {
        colours.iter().map(|&colour| Image::new(1, 1, vec![Rgb(colour)])).collect()
    }

    #[test]
    fn white_has_the_chromaticity_of_d65() {
        let [u, v] = chromaticity([0.5; 3]);
        assert!((u - 0.1978).abs() < 1e-4 && (v - 0.4683).abs() < 1e-4, "{u} {v}");
    }

    #[test]
    fn slopes_of_the_chromaticity_are_those_of_differences() {
        let linear = [0.3, 0.2, 0.6];
        let (_, slopes) = chromaticity_and_slopes(linear);
        for channel in 0..3 {
            let moved = |by: f64| {
                let mut moved = linear;
                moved[channel] += by;
                chromaticity(moved)
            };
            let (low, high) = (moved(-1e-5), moved(1e-5));
            for axis in 0..2 {
                assert!((slopes[channel][axis] - (high[axis] - low[axis]) / 2e-5).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_path_at_rest_is_straight_and_even() {
        let smoothness = Smoothness::of(&path(&[[0.2, 0.3, 0.4]; 4]), &[true]);
        assert_eq!(smoothness, Smoothness { length_ratio: 1.0, step_ratio: 1.0, hue_excursion: 0.0 });
    }

    #[test]
    fn a_jump_among_four_steps_has_step_ratio_four() {
        let dark = [0.1; 3];
        let smoothness = Smoothness::of(&path(&[dark, dark, dark, dark, [0.8; 3]]), &[true]);
        assert!((smoothness.step_ratio - 4.0).abs() < 1e-12 && (smoothness.length_ratio - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_detour_through_green_is_an_excursion_and_a_mix_is_none() {
        let (red, blue) = ([0.6, 0.1, 0.1], [0.1, 0.1, 0.6]);
        let middle = [0.35, 0.1, 0.35];
        assert!(hue_excursion(&path(&[red, middle, blue]), &[true]) < 1e-6);
        assert!(hue_excursion(&path(&[red, [0.1, 0.6, 0.1], blue]), &[true]) > 0.1);
    }

    #[test]
    fn changes_of_the_detour_are_those_of_differences() {
        let (from, to) = ([0.1, 0.2], [0.3, 0.3]);
        for point in [[0.2, 0.3], [0.0, 0.1], [0.4, 0.4]] {
            for change in [[1.0, 0.0], [0.0, 1.0], [0.6, -0.8]] {
                let moved = |by: f64| detour([point[0] + by * change[0], point[1] + by * change[1]], from, to);
                let (high, low, found) = (moved(1e-6), moved(-1e-6), change_of_detour(point, from, to, change));
                for axis in 0..2 {
                    assert!((found[axis] - (high[axis] - low[axis]) / 2e-6).abs() < 1e-6, "{point:?} {change:?}");
                }
            }
        }
    }

    #[test]
    fn there_and_back_is_a_loop_of_infinite_ratio() {
        let smoothness = Smoothness::of(&path(&[[0.1; 3], [0.5; 3], [0.1; 3]]), &[true]);
        assert_eq!(smoothness.length_ratio, f64::INFINITY);
    }
}
