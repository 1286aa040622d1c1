//! When to be where on a path, so that it is walked at an even pace, as it is seen.

use super::{Path, PathError, Weights};
use crate::Image;
use crate::metric::ItpImage;
use crate::render::{Light, Sphere};

/// Pieces that the length between two ends is summed over.
const PIECES: usize = 32;
/// Side of the sphere whose changes are the length \[pixels\].
const SIZE: usize = 64;

/// The t of a path at which equal steps of time are equal steps of ΔE_ITP under light `studio`. Several ends keep their
/// times, so that keys stay where they are; the pace is even from each to the next. Beyond the ends it goes on as it is
/// there, and where it is faster than the plain one it fades to that.
#[derive(Clone, Debug)]
pub struct Clock {
    /// From each end to the next.
    spans: Vec<Span>,
}

/// Share of a span's length behind each of its pieces, from 0 to 1, never falling.
#[derive(Clone, Debug)]
struct Span(Vec<f64>);

impl Clock {
    /// Of a path between so many ends, walked along the [spline](Weights::along_spline) through them.
    ///
    /// # Errors
    /// If a point of the path cannot be made.
    pub fn of(path: &dyn Path, ends: usize) -> Result<Self, PathError> {
        let count = ends.saturating_sub(1).max(1);
        let place = |piece: usize| piece as f32 / (PIECES * count) as f32;
        // Straight from one of two to the other, to the last bit.
        let weights = |t: f32| if ends == 2 { Weights::two(t) } else { Weights::along_spline(t, ends) };
        let sphere = Sphere::new(SIZE, &Light::studio());
        let mut image = Image::black(SIZE, SIZE);
        let mut point = path.at(&weights(0.0))?;
        let [mut before, mut now] = [ItpImage::default(), ItpImage::default()];
        let mut steps = Vec::with_capacity(PIECES * count);
        for piece in 0..=PIECES * count {
            path.move_to(&weights(place(piece)), &mut point)?;
            sphere.render_into(point.as_ref(), &mut image);
            now.renew(&image, 1.0);
            if piece > 0 {
                steps.push(now.distance(&before, sphere.covered()));
            }
            std::mem::swap(&mut before, &mut now);
        }
        Ok(Self { spans: steps.chunks(PIECES).map(Span::of).collect() })
    }

    /// The t of the path at a time; one that is no number stays none.
    pub fn set(&self, time: f32) -> f32 {
        if !time.is_finite() {
            return time;
        }
        let count = self.spans.len();
        let place = f64::from(time) * count as f64;
        let span = (place.max(0.0) as usize).min(count - 1);
        let within = place - span as f64;
        // At a key between two spans nothing lies beyond.
        ((span as f64 + self.spans[span].set(within)) / count as f64) as f32
    }
}

impl Span {
    fn of(steps: &[f64]) -> Self {
        let mut lengths = vec![0.0; PIECES + 1];
        for (piece, step) in steps.iter().enumerate() {
            lengths[piece + 1] = lengths[piece] + step;
        }
        let whole = lengths[PIECES];
        // A path at rest has any pace.
        let share =
            |(piece, length): (usize, f64)| if whole > 0.0 { length / whole } else { piece as f64 / PIECES as f64 };
        Self(lengths.into_iter().enumerate().map(share).collect())
    }

    /// Where in the span it is at a share of the length.
    fn set(&self, share: f64) -> f64 {
        if share <= 0.0 {
            return -beyond(-share, self.0[1]);
        }
        if share >= 1.0 {
            return 1.0 + beyond(share - 1.0, 1.0 - self.0[PIECES - 1]);
        }
        let after = self.0.partition_point(|&known| known < share).clamp(1, PIECES);
        let [low, high] = [self.0[after - 1], self.0[after]];
        // A piece at rest is passed at once.
        let within = if high > low { (share - low) / (high - low) } else { 1.0 };
        ((after - 1) as f64 + within.min(1.0)) / PIECES as f64
    }
}

/// How far to go for a share `by` of the length beyond an end whose last piece has `length` of it. The pace at the end
/// is that of the piece, 1 / (length · PIECES); above 1 it fades to 1, before a piece's worth has been won.
fn beyond(by: f64, length: f64) -> f64 {
    let piece = 1.0 / PIECES as f64;
    match length {
        // A piece at rest has no pace.
        _ if length <= 0.0 => by,
        _ if length >= piece => by * piece / length,
        _ => by - (piece - length) * (-by / length).exp_m1(),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::brdf::lambert::Lambert;
    use crate::path::mix::Mix;
    use crate::{Interpolation as _, Material, Rgb};

    fn power(power: f64) -> Clock {
        Clock { spans: vec![Span((0..=PIECES).map(|k| (k as f64 / PIECES as f64).powf(power)).collect())] }
    }

    #[test]
    fn the_pace_at_an_end_goes_on_beyond_it() {
        for clock in [0.5, 2.0].map(power) {
            let inner = |t: f32| f64::from(clock.set(t));
            for end in [0.0, 1.0] {
                let (before, after) = (inner(end) - inner(end - 2e-5), inner(end + 2e-5) - inner(end));
                assert!((before / after - 1.0).abs() < 0.1, "{clock:?} at {end}: {before} {after}");
            }
        }
        assert!(power(1.0).set(f32::NAN).is_nan());
    }

    #[test]
    fn the_ends_stay_the_ends() {
        let clock = power(2.0);
        assert_eq!((clock.set(0.0), clock.set(1.0)), (0.0, 1.0));
        assert!((clock.set(0.25) - 0.5).abs() < 1e-3);
        assert!(clock.set(-0.25) < 0.0 && clock.set(1.25) > 1.0);
    }

    #[test]
    fn keys_keep_their_times_and_each_span_is_walked_evenly() {
        let greys = [0.05, 0.1, 0.9]
            .map(|albedo| Material::new("grey", std::sync::Arc::new(Lambert { albedo: Rgb::splat(albedo) })));
        let path = Mix::Linear.between(&greys).unwrap();
        let clock = Clock::of(path.as_ref(), 3).unwrap();
        for key in [0.0, 0.5, 1.0] {
            assert!((clock.set(key) - key).abs() < 1e-6, "{key}: {}", clock.set(key));
        }
        // From dark to bright most of the change comes first.
        assert!(clock.set(0.75) < 0.72, "{}", clock.set(0.75));
        let times: Vec<f32> = (0..=100u8).map(|k| clock.set(f32::from(k) / 50.0 - 0.5)).collect();
        assert!(times.windows(2).all(|pair| pair[0] <= pair[1]), "{times:?}");
    }

    proptest! {
        #[test]
        fn time_never_runs_backwards(steps in prop::collection::vec(0.0..1.0f64, PIECES), a in -0.5..1.5f32, b in -0.5..1.5f32) {
            let clock = Clock { spans: vec![Span::of(&steps)] };
            let [a, b] = [a.min(b), a.max(b)].map(|t| clock.set(t));
            prop_assert!(a <= b && a.is_finite() && b.is_finite());
        }
    }
}
