//! Colour spaces of FLIP: sRGB → linear → YCxCz for filtering, CIELAB with Hunt's effect for comparing.

use crate::Rgb;

/// L*, and a*, b* scaled by Hunt's effect (colours fade in the dark).
pub(super) type Lab = [f64; 3];

/// Linear BT.709 → XYZ, in the rationals of the reference programs.
const XYZ_FROM_LINEAR: [[f64; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];
const LINEAR_FROM_XYZ: [[f64; 3]; 3] = inverse(XYZ_FROM_LINEAR);
/// XYZ of linear white: the row sums.
const WHITE: [f64; 3] = times(&XYZ_FROM_LINEAR, [1.0; 3]);
/// Below (6/29)³ CIELAB is linear.
const LAB_BEND: f64 = 6.0 / 29.0;

pub(super) fn ycxcz_from_srgb(Rgb(srgb): Rgb) -> [f64; 3] {
    let [x, y, z] = relative_xyz(srgb.map(|v| linear_from_srgb(f64::from(v))));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// Linear BT.709, not clipped.
pub(super) fn linear_from_ycxcz([y, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (y + 16.0) / 116.0;
    let xyz = [y + cx / 500.0, y, y - cz / 200.0];
    times(&LINEAR_FROM_XYZ, std::array::from_fn(|i| xyz[i] * WHITE[i]))
}

pub(super) fn hunt_lab_from_linear(linear: [f64; 3]) -> Lab {
    let [x, y, z] = relative_xyz(linear).map(lab_curve);
    let l = 116.0 * y - 16.0;
    [l, 0.01 * l * 500.0 * (x - y), 0.01 * l * 200.0 * (y - z)]
}

/// City-block in lightness, Euclidean in colour (Abasi, Tehran, Fairchild 2020).
pub(super) fn hyab_hunt(f: Lab, g: Lab) -> f64 {
    (f[0] - g[0]).abs() + ((f[1] - g[1]).powi(2) + (f[2] - g[2]).powi(2)).sqrt()
}

fn relative_xyz(linear: [f64; 3]) -> [f64; 3] {
    let xyz = times(&XYZ_FROM_LINEAR, linear);
    std::array::from_fn(|i| xyz[i] / WHITE[i])
}

fn linear_from_srgb(v: f64) -> f64 {
    if v > 0.04045 { ((v + 0.055) / 1.055).powf(2.4) } else { v / 12.92 }
}

fn lab_curve(t: f64) -> f64 {
    if t > LAB_BEND * LAB_BEND * LAB_BEND { t.cbrt() } else { t / (3.0 * LAB_BEND * LAB_BEND) + 4.0 / 29.0 }
}

const fn times(m: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [
        m[0][0] * v[0] + m[0][1] * v[1] + m[0][2] * v[2],
        m[1][0] * v[0] + m[1][1] * v[1] + m[1][2] * v[2],
        m[2][0] * v[0] + m[2][1] * v[1] + m[2][2] * v[2],
    ]
}

/// By cofactors.
const fn inverse(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut inverse = [[0.0; 3]; 3];
    let mut i = 0;
    while i < 9 {
        let (row, column) = (i / 3, i % 3);
        let (r1, r2, c1, c2) = ((row + 1) % 3, (row + 2) % 3, (column + 1) % 3, (column + 2) % 3);
        inverse[column][row] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        i += 1;
    }
    let determinant = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0];
    let mut i = 0;
    while i < 9 {
        inverse[i / 3][i % 3] /= determinant;
        i += 1;
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opponent_colours_lead_back_to_linear_ones() {
        let srgb = Rgb([0.1, 0.6, 0.9]);
        let back = linear_from_ycxcz(ycxcz_from_srgb(srgb));
        for channel in 0..3 {
            assert!((back[channel] - linear_from_srgb(f64::from(srgb[channel]))).abs() < 1e-12);
        }
    }

    #[test]
    fn white_has_lightness_one_hundred_and_no_colour() {
        let [l, a, b] = hunt_lab_from_linear([1.0; 3]);
        assert!((l - 100.0).abs() < 1e-9 && a.abs() < 1e-9 && b.abs() < 1e-9);
    }
}
