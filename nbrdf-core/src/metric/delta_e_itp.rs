//! `delta_e_itp`: colour difference as seen on a television of 100 cd/m².
//!
//! Recommendation ITU-R BT.2124-0 (2019): linear BT.709 clipped to 0..1 → BT.2020 (BT.2087) → LMS → PQ (BT.2100,
//! white at 100 cd/m²) → ICtCp; ΔE = 720 √(ΔI² + ΔT² + ΔP²) with T = ½ C_T. One unit is just noticeable.

use rayon::prelude::*;

use super::psnr::assert_same_size;
use crate::{Image, Rgb, image::clipped};

/// BT.709 → BT.2020, derived from the primaries (BT.2087 prints four digits of it).
const BT2020_FROM_BT709: [[f64; 3]; 3] = [
    [0.627_403_895_934_699, 0.329_283_038_377_884, 0.043_313_065_687_417],
    [0.069_097_289_358_232, 0.919_540_395_075_459, 0.011_362_315_566_309],
    [0.016_391_438_875_150, 0.088_013_307_877_226, 0.895_595_253_247_624],
];
/// BT.2020 → LMS, times 4096 (BT.2100, table 7).
const LMS_FROM_BT2020: [[f64; 3]; 3] = [[1688.0, 2146.0, 262.0], [683.0, 2951.0, 462.0], [99.0, 309.0, 3688.0]];
/// PQ-encoded LMS → ICtCp, times 4096 (BT.2100, table 7).
const ICTCP_FROM_LMS: [[f64; 3]; 3] = [[2048.0, 2048.0, 0.0], [6610.0, -13613.0, 7003.0], [17933.0, -17390.0, -543.0]];
/// Luminance of linear 1 in units of PQ's 10 000 cd/m².
const WHITE: f64 = 100.0 / 10_000.0;

/// A picture in I, T, P: worth keeping where one picture is compared with several.
#[derive(Clone, Debug, Default)]
pub struct ItpImage {
    width: usize,
    height: usize,
    pixels: Vec<[f64; 3]>,
}

impl ItpImage {
    /// From a linear image.
    pub fn new(linear: &Image) -> Self {
        let mut itp = Self::default();
        itp.renew(linear, 1.0);
        itp
    }

    /// Takes the place of this picture: a linear image times `gain`. Allocates nothing where there is room.
    pub fn renew(&mut self, linear: &Image, gain: f32) {
        let black = itp_from_linear(Rgb::BLACK);
        let convert = |&pixel: &Rgb| if pixel == Rgb::BLACK { black } else { itp_from_linear(pixel * gain) };
        (self.width, self.height) = (linear.width(), linear.height());
        self.pixels.clear();
        self.pixels.extend(linear.pixels().iter().map(convert));
    }

    /// Mean ΔE_ITP to another picture over covered pixels, from 0 up; 0 where nothing is covered.
    ///
    /// # Panics
    /// If the pictures or the mask differ in size (a bug of the caller).
    pub fn distance(&self, other: &Self, covered: &[bool]) -> f64 {
        assert_eq!((self.width, self.height), (other.width, other.height), "images of one size");
        assert_eq!(self.pixels.len(), covered.len(), "one mask entry per pixel");
        let (mut sum, mut count) = (0.0, 0_usize);
        for ((f, g), _) in self.pixels.iter().zip(&other.pixels).zip(covered).filter(|&(_, &on)| on) {
            sum += difference(f, g);
            count += 1;
        }
        sum / count.max(1) as f64
    }
}

/// Mean ΔE_ITP of two *linear* images over covered pixels, from 0 up.
///
/// # Panics
/// If the images or the mask differ in size (a bug of the caller).
pub fn delta_e_itp(reference: &Image, other: &Image, covered: &[bool]) -> f64 {
    assert_same_size(reference, other, covered);
    ItpImage::new(reference).distance(&ItpImage::new(other), covered)
}

/// ΔE_ITP of two *linear* images pixel by pixel, row by row from the top left.
///
/// # Panics
/// If the images differ in size (a bug of the caller).
pub fn delta_e_itp_map(reference: &Image, other: &Image) -> Vec<f32> {
    assert_eq!((reference.width(), reference.height()), (other.width(), other.height()), "images of one size");
    let pairs = reference.pixels().par_iter().zip(other.pixels());
    let of = |(&f, &g): (&Rgb, &Rgb)| {
        // Off a sphere both are black.
        if f == g { 0.0 } else { difference(&itp_from_linear(f), &itp_from_linear(g)) as f32 }
    };
    pairs.map(of).collect()
}

fn difference(f: &[f64; 3], g: &[f64; 3]) -> f64 {
    720.0 * f.iter().zip(g).map(|(f, g)| (f - g) * (f - g)).sum::<f64>().sqrt()
}

fn itp_from_linear(linear: Rgb) -> [f64; 3] {
    itp(lms_from_linear(linear).map(pq))
}

/// I, T, P of a linear colour, and how they move with its channels: row by row, ∂(I, T, P)/∂channel. A channel that is
/// clipped moves nothing.
pub fn itp_and_slopes(linear: Rgb) -> ([f64; 3], [[f64; 3]; 3]) {
    let lms = lms_from_linear(linear);
    let slope = lms.map(pq_slope);
    let by_channel = |channel: usize| {
        let is_inside = linear[channel] >= 0.0 && linear[channel] <= 1.0;
        let unit = [0, 1, 2].map(|c| f64::from(u8::from(c == channel && is_inside)));
        let moved = lms_from(unit);
        itp([0, 1, 2].map(|cone| slope[cone] * moved[cone]))
    };
    (itp(lms.map(pq)), [0, 1, 2].map(by_channel))
}

fn lms_from_linear(Rgb(linear): Rgb) -> [f64; 3] {
    lms_from(linear.map(|v| f64::from(clipped(v))))
}

/// Cone responses in units of 10 000 cd/m².
fn lms_from(linear: [f64; 3]) -> [f64; 3] {
    times(&LMS_FROM_BT2020, times(&BT2020_FROM_BT709, linear)).map(|v| WHITE * v / 4096.0)
}

/// From PQ-encoded cone responses.
fn itp(lms: [f64; 3]) -> [f64; 3] {
    let [i, t, p] = times(&ICTCP_FROM_LMS, lms).map(|v| v / 4096.0);
    [i, 0.5 * t, p]
}

/// PQ's inverse EOTF (SMPTE ST 2084): display light in units of 10 000 cd/m² to signal.
fn pq(light: f64) -> f64 {
    let y = light.max(0.0).powf(2610.0 / 16384.0);
    ((3424.0 / 4096.0 + 2413.0 / 128.0 * y) / (1.0 + 2392.0 / 128.0 * y)).powf(2523.0 / 32.0)
}

/// Slope of [`pq`]; that at 10⁻⁷ (0.001 cd/m²) for darker light, where it has no bound.
fn pq_slope(light: f64) -> f64 {
    let (m, n) = (2610.0 / 16384.0, 2523.0 / 32.0);
    let light = light.max(1e-7);
    let y = light.powf(m);
    let (over, under) = (3424.0 / 4096.0 + 2413.0 / 128.0 * y, 1.0 + 2392.0 / 128.0 * y);
    let by_y = n * (over / under).powf(n - 1.0) * (2413.0 / 128.0 * under - over * 2392.0 / 128.0) / (under * under);
    by_y * m * y / light
}

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_at_100_candela_has_signal_0_508_and_no_colour() {
        let [i, t, p] = itp_from_linear(Rgb::splat(1.0));
        assert!((i - 0.508_078).abs() < 1e-5, "{i}");
        assert!(t.abs() < 1e-9 && p.abs() < 1e-9, "{t} {p}");
    }

    #[test]
    fn slopes_are_those_of_differences() {
        for linear in [[0.3, 0.2, 0.7], [0.01, 0.5, 0.02], [0.9, 1e-3, 1.5]] {
            let (_, slopes) = itp_and_slopes(Rgb(linear));
            for channel in 0..3 {
                let mut moved = [linear; 2];
                let offset = 1e-3 * linear[channel];
                moved[0][channel] -= offset;
                moved[1][channel] += offset;
                let [low, high] = moved.map(|linear| itp_from_linear(Rgb(linear)));
                let width = f64::from(moved[1][channel].min(1.0) - moved[0][channel].min(1.0)).max(1e-9);
                for axis in 0..3 {
                    let expected = (high[axis] - low[axis]) / width;
                    let found = slopes[channel][axis];
                    assert!((found - expected).abs() < 1e-3 * (0.1 + expected.abs()), "{linear:?}: {found} {expected}");
                }
            }
        }
    }

    #[test]
    fn values_beyond_white_do_not_count() {
        let image = |v: f32| Image::new(1, 1, vec![Rgb::splat(v)]);
        assert_eq!(delta_e_itp(&image(1.0), &image(50.0), &[true]), 0.0);
        assert!(delta_e_itp(&image(1.0), &image(0.5), &[true]) > 10.0);
    }

    #[test]
    fn the_map_averages_to_the_figure() {
        let f = Image::new(2, 1, vec![Rgb([0.1, 0.2, 0.3]), Rgb([0.9, 0.5, 0.1])]);
        let g = Image::new(2, 1, vec![Rgb([0.2, 0.2, 0.3]), Rgb([0.9, 0.4, 0.1])]);
        let map = delta_e_itp_map(&f, &g);
        let mean = f64::from(map[0] + map[1]) / 2.0;
        assert!((mean - delta_e_itp(&f, &g, &[true, true])).abs() < 1e-4);
    }
}
