//! How densely a table's places lie along an axis: where a function bends.
//!
//! Straight lines between places miss a function by h² |f''| / 8, h apart; for a given number of places the sum of what they
//! miss is least where they lie as densely as the cube root of |f''| (C. de Boor, *A Practical Guide to Splines* (1978),
//! chapter III).

/// Bends are averaged over so many places on either side: their noise would otherwise leave gaps.
const SMOOTH: usize = 3;

/// A density over 0..1, linear between even places, of mean 1.
pub(super) struct Density {
    values: Vec<f64>,
    /// Its integral up to every place.
    below: Vec<f64>,
}

impl Density {
    /// Of a function whose second derivative has these sizes, of any scale, at three even places or more; nowhere is it less
    /// dense than `floor` times the mean.
    pub fn of_bends(bends: &[f64], floor: f64) -> Self {
        let last = bends.len() - 1;
        // The ends have no bend of their own.
        let root = |place: usize| bends[place.clamp(1, last - 1)].cbrt();
        let smooth = |place: usize| {
            let around = place.saturating_sub(SMOOTH)..=(place + SMOOTH).min(last);
            let count = around.clone().count() as f64;
            around.map(root).sum::<f64>() / count
        };
        let smoothed: Vec<f64> = (0..=last).map(smooth).collect();
        let mean = trapezia(&smoothed).last().copied().unwrap_or_default();
        // What bends nowhere is even.
        let relative = |value: f64| if mean > 0.0 { (1.0 - floor) * value / mean + floor } else { 1.0 };
        let values: Vec<f64> = smoothed.into_iter().map(relative).collect();
        let below = trapezia(&values);
        Self { values, below }
    }

    /// The density at even places from 0 to 1.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The place below which this share (0..1) of all lies, and the density there.
    pub fn place(&self, share: f64) -> (f64, f64) {
        let last = self.values.len() - 1;
        let cell = (self.below.partition_point(|&below| below <= share)).clamp(1, last) - 1;
        let [low, high] = [self.values[cell], self.values[cell + 1]];
        // Solves low t + (high − low) t² / 2 = rest in the form that keeps its digits where the two are alike.
        let rest = (share - self.below[cell]) * last as f64;
        let root = (low * low + 2.0 * rest * (high - low)).max(0.0).sqrt();
        let within = (2.0 * rest / (low + root)).clamp(0.0, 1.0);
        ((cell as f64 + within) / last as f64, low + within * (high - low))
    }
}

/// Integrals of a function that is linear between even places of 0..1, up to every place.
fn trapezia(values: &[f64]) -> Vec<f64> {
    let width = 1.0 / (values.len() - 1) as f64;
    let sum = |sum: &mut f64, pair: &[f64]| {
        *sum += 0.5 * width * (pair[0] + pair[1]);
        Some(*sum)
    };
    std::iter::once(0.0).chain(values.windows(2).scan(0.0, sum)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_bends_evenly_or_not_at_all_has_even_places() {
        for bend in [0.0, 3.0] {
            let density = Density::of_bends(&[bend; 9], 0.2);
            for share in [0.0, 0.3, 0.75, 1.0] {
                let (place, density) = density.place(share);
                assert!((place - share).abs() < 1e-12 && (density - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn places_crowd_where_it_bends_and_shares_are_integrals_of_the_density() {
        let mut bends = [1e-3; 65];
        bends[..16].fill(1.0);
        let density = Density::of_bends(&bends, 0.1);
        assert!(density.place(0.5).0 < 0.2);
        let mut before = 0.0;
        for share in (1..=100).map(|k| f64::from(k) / 100.0) {
            let (place, value) = density.place(share);
            assert!(place > before && place <= 1.0 + 1e-12 && value >= 0.1 * 0.9, "{share}: {place}");
            let step = 1e-6;
            let slope =
                2.0 * step / (density.place(share.min(0.99) + step).0 - density.place(share.min(0.99) - step).0);
            assert!(share > 0.99 || (slope / value - 1.0).abs() < 1e-3, "{share}: {slope}, {value}");
            before = place;
        }
        assert!((before - 1.0).abs() < 1e-9);
    }
}
