//! Well-distributed points of the unit square for one pixel, pass after pass.
//!
//! The additive recurrence R₂ (M. Roberts, *The Unreasonable Effectiveness of Quasirandom Sequences*, 2018), shifted
//! for each pixel by a hash (R. Cranley, T. Patterson, *Randomization of Number Theoretic Methods for Multiple
//! Integration*, 1976), so that neighbours err independently. A point depends on nothing but seed, pixel, purpose and
//! pass.

/// 2⁶⁴/ρ and 2⁶⁴/ρ², ρ the root of ρ³ = ρ + 1: in fixed point the recurrence is exact for any number of passes.
const STEP: [u64; 2] = [13_925_035_116_211_876_495, 10_511_698_010_929_265_436];

/// A point of \[0, 1)², 64 bits after the point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Point([u64; 2]);

impl Point {
    /// Of a pixel (by its index) in a pass (from 0); each `purpose` has a sequence of its own.
    pub(crate) fn new(seed: u64, pixel: u64, purpose: u64, pass: u64) -> Self {
        let shift = mixed(mixed(mixed(seed) ^ pixel) ^ purpose);
        let shifts = [mixed(shift), mixed(!shift)];
        Self([0, 1].map(|i| shifts[i].wrapping_add(STEP[i].wrapping_mul(pass))))
    }

    /// With 53 bits.
    pub(crate) fn f64(self) -> [f64; 2] {
        self.0.map(|bits| (bits >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// With 24 bits: rounding all of them could reach 1.
    pub(crate) fn f32(self) -> [f32; 2] {
        self.0.map(|bits| (bits >> 40) as f32 / (1_u32 << 24) as f32)
    }
}

/// One step of SplitMix64 (G. Steele, D. Lea, C. Flood, *Fast Splittable Pseudorandom Number Generators*, 2014).
fn mixed(state: u64) -> u64 {
    let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First numbers of the published generator for the seed 0.
    #[test]
    fn mixing_is_splitmix64() {
        assert_eq!(mixed(0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(mixed(0x9e37_79b9_7f4a_7c15), 0x6e78_9e6a_a1b9_65f4);
    }

    #[test]
    fn points_of_one_pixel_fill_the_square_evenly() {
        let n = 16;
        let mut counts = vec![0; n * n];
        for pass in 0..4096 {
            let [u, v] = Point::new(7, 3, 0, pass).f64().map(|share| (share * n as f64) as usize);
            counts[v * n + u] += 1;
        }
        assert!(counts.iter().all(|count| (12..=20).contains(count)), "16 in each cell: {counts:?}");
    }

    #[test]
    fn first_points_of_neighbouring_pixels_are_spread_over_the_square() {
        for purpose in 0..2 {
            let points: Vec<_> = (0..10_000).map(|pixel| Point::new(0, pixel, purpose, 0).f64()).collect();
            for axis in 0..2 {
                let mean = points.iter().map(|point| point[axis]).sum::<f64>() / 1e4;
                assert!((mean - 0.5).abs() < 0.01, "{mean}");
            }
            let product = points.iter().map(|[u, v]| (u - 0.5) * (v - 0.5)).sum::<f64>() / 1e4;
            assert!(product.abs() < 0.003, "the axes do not move together: {product}");
        }
    }

    #[test]
    fn every_part_of_a_points_name_counts() {
        let points = [
            Point::new(0, 0, 0, 0),
            Point::new(1, 0, 0, 0),
            Point::new(0, 1, 0, 0),
            Point::new(0, 0, 1, 0),
            Point::new(0, 0, 0, 1),
        ];
        for (i, point) in points.iter().enumerate() {
            assert!(!points[..i].contains(point));
        }
    }

    #[test]
    fn no_point_reaches_one() {
        let last = Point([u64::MAX; 2]);
        assert!(last.f64()[0] < 1.0 && last.f32()[0] < 1.0);
    }
}
