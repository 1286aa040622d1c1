//! Reflectance spectra as linear RGB: CIE 1931 2° observer, illuminant D65 or E, BT.709 primaries.

use crate::Rgb;

/// x̄, ȳ, z̄ of the CIE 1931 2° observer and the relative power of illuminant D65, 400 to 700 nm in steps of 10
/// (CIE 015:2018, tables 1 and 6).
const TABLE: [[f64; 4]; 31] = [
    [0.014310, 0.000396, 0.067850, 82.7549],
    [0.043510, 0.001210, 0.207400, 91.4860],
    [0.134380, 0.004000, 0.645600, 93.4318],
    [0.283900, 0.011600, 1.385600, 86.6823],
    [0.348280, 0.023000, 1.747060, 104.865],
    [0.336200, 0.038000, 1.772110, 117.008],
    [0.290800, 0.060000, 1.669200, 117.812],
    [0.195360, 0.090980, 1.287640, 114.861],
    [0.095640, 0.139020, 0.812950, 115.923],
    [0.032010, 0.208020, 0.465180, 108.811],
    [0.004900, 0.323000, 0.272000, 109.354],
    [0.009300, 0.503000, 0.158200, 107.802],
    [0.063270, 0.710000, 0.078250, 104.790],
    [0.165500, 0.862000, 0.042160, 107.689],
    [0.290400, 0.954000, 0.020300, 104.405],
    [0.433450, 0.994950, 0.008750, 104.046],
    [0.594500, 0.995000, 0.003900, 100.000],
    [0.762100, 0.952000, 0.002100, 96.3342],
    [0.916300, 0.870000, 0.001650, 95.7880],
    [1.026300, 0.757000, 0.001100, 88.6856],
    [1.062200, 0.631000, 0.000800, 90.0062],
    [1.002600, 0.503000, 0.000340, 89.5991],
    [0.854450, 0.381000, 0.000190, 87.6987],
    [0.642400, 0.265000, 0.000050, 83.2886],
    [0.447900, 0.175000, 0.000020, 83.6992],
    [0.283500, 0.107000, 0.000000, 80.0268],
    [0.164900, 0.061000, 0.000000, 80.2146],
    [0.087400, 0.032000, 0.000000, 82.2778],
    [0.046770, 0.017000, 0.000000, 78.2842],
    [0.022700, 0.008210, 0.000000, 69.7213],
    [0.011359, 0.004102, 0.000000, 71.6091],
];
/// First wavelength of the table, and its step \[nm\].
const FIRST: f64 = 400.0;
const STEP: f64 = 10.0;
/// XYZ → linear BT.709 (IEC 61966-2-1).
const BT709_FROM_XYZ: [[f64; 3]; 3] = [
    [3.240_969_941_904_523, -1.537_383_177_570_094, -0.498_610_760_293_003],
    [-0.969_243_636_280_88, 1.875_967_501_507_72, 0.041_555_057_407_176],
    [0.055_630_079_696_994, -0.203_976_958_888_977, 1.056_971_514_242_879],
];

/// The light under which a spectrum is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Illuminant {
    /// Daylight, the white of BT.709: a white reflector is white.
    #[default]
    D65,
    /// Equal power everywhere, adapted to D65 by scaling each channel: a white reflector is white.
    E,
}

/// Turns spectra at fixed wavelengths into RGB.
pub struct Observer {
    /// What each wavelength adds to red, green, blue.
    weights: Vec<[f64; 3]>,
}

impl Observer {
    /// For these wavelengths \[nm\], rising; those outside 400..700 nm add nothing, between the table's it is interpolated.
    /// White comes out as 1, 1, 1. None where the wavelengths do not make white: too few of them are seen.
    pub fn new(wavelengths: &[f64], illuminant: Illuminant) -> Option<Self> {
        let seen = |(i, &nm): (usize, &f64)| {
            let [x, y, z, power] = sensitivity(nm);
            let power = if illuminant == Illuminant::D65 { power } else { 100.0 };
            let width = width(wavelengths, i);
            let rgb = BT709_FROM_XYZ.map(|row| row[0] * x + row[1] * y + row[2] * z);
            rgb.map(|v| v * power * width)
        };
        let mut weights: Vec<[f64; 3]> = wavelengths.iter().enumerate().map(seen).collect();
        let white = weights.iter().fold([0.0; 3], |sum, w| [0, 1, 2].map(|c| sum[c] + w[c]));
        if !white.iter().all(|&sum| sum > 0.0) {
            return None;
        }
        for weight in &mut weights {
            *weight = [0, 1, 2].map(|c| weight[c] / white[c]);
        }
        Some(Self { weights })
    }

    /// The colour of a reflectance spectrum; negative where it lies outside BT.709.
    pub fn rgb(&self, spectrum: impl IntoIterator<Item = f64>) -> Rgb {
        let pairs = spectrum.into_iter().zip(&self.weights);
        let sum = pairs.fold([0.0; 3], |sum, (value, weight)| [0, 1, 2].map(|c| sum[c] + value * weight[c]));
        Rgb(sum.map(|v| v as f32))
    }
}

/// Half the way to both neighbours.
fn width(wavelengths: &[f64], i: usize) -> f64 {
    let last = wavelengths.len() - 1;
    0.5 * (wavelengths[(i + 1).min(last)] - wavelengths[i.saturating_sub(1)])
}

fn sensitivity(nm: f64) -> [f64; 4] {
    let place = (nm - FIRST) / STEP;
    if !(0.0..=(TABLE.len() - 1) as f64).contains(&place) {
        return [0.0; 4];
    }
    let low = (place as usize).min(TABLE.len() - 2);
    let share = place - low as f64;
    std::array::from_fn(|i| TABLE[low][i] + share * (TABLE[low + 1][i] - TABLE[low][i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavelengths() -> Vec<f64> {
        (0..31).map(|i| 400.0 + 10.0 * f64::from(i)).collect()
    }

    #[test]
    fn white_is_white_under_both_lights() {
        for illuminant in [Illuminant::D65, Illuminant::E] {
            let Rgb(white) = Observer::new(&wavelengths(), illuminant).unwrap().rgb([0.5; 31]);
            assert!(white.iter().all(|v| (v - 0.5).abs() < 1e-6), "{white:?}");
        }
    }

    #[test]
    fn long_waves_are_red_and_short_ones_blue() {
        let observer = Observer::new(&wavelengths(), Illuminant::D65).unwrap();
        let band = |from: usize, to: usize| observer.rgb((0..31).map(|i| f64::from(u8::from((from..to).contains(&i)))));
        let (red, blue) = (band(20, 31), band(0, 8));
        assert!(Observer::new(&[900.0, 1000.0], Illuminant::D65).is_none(), "infrared has no colour");
        assert!(red[0] > 0.8 && red[2] < 0.1, "{red:?}");
        assert!(blue[2] > 0.8 && blue[0] < 0.2, "{blue:?}");
    }
}
