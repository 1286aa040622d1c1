//! Any path walked at an even pace, as it is seen: equal steps of t are equal steps of ΔE_ITP.

use super::{Interpolation, Path, PathError, Weights};
use crate::metric::ItpImage;
use crate::render::{Light, Sphere};
use crate::{Brdf, Code, Image, Material, Warning};

/// Pieces that the length of a path is summed over.
const PIECES: usize = 32;
/// Side of the sphere whose changes are the length \[pixels\].
const SIZE: usize = 64;

/// Another interpolation, re-timed between two ends by the length of its path under light `studio`. Beyond the ends it
/// goes on at the pace it has there; a pace above the plain one fades to that. Paths between three ends and more have no
/// length and stay as they are.
pub struct Even {
    name: &'static str,
    inner: Box<dyn Interpolation>,
}

impl Even {
    /// Under the name that reports use.
    pub fn new(name: &'static str, inner: Box<dyn Interpolation>) -> Self {
        Self { name, inner }
    }
}

impl Interpolation for Even {
    fn name(&self) -> &'static str {
        self.name
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        let path = self.inner.between(ends)?;
        if ends.len() != 2 {
            return Ok(path);
        }
        let clock = Clock::of(path.as_ref())?;
        Ok(Box::new(EvenPath { path, clock }))
    }
}

struct EvenPath {
    path: Box<dyn Path>,
    clock: Clock,
}

impl Path for EvenPath {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        self.path.at(&self.clock.set(weights)?)
    }

    fn code(&self, weights: &Weights) -> Result<Option<Code>, PathError> {
        self.path.code(&self.clock.set(weights)?)
    }

    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        self.path.move_to(&self.clock.set(weights)?, point)
    }

    fn warnings(&self, weights: &Weights) -> Result<Vec<Warning>, PathError> {
        self.path.warnings(&self.clock.set(weights)?)
    }
}

/// Where a path is at each share of its length.
#[derive(Debug)]
struct Clock {
    /// Share of the length behind t = k / PIECES, from 0 to 1, never falling.
    shares: Vec<f64>,
}

impl Clock {
    fn of(path: &dyn Path) -> Result<Self, PathError> {
        let sphere = Sphere::new(SIZE, &Light::studio());
        let mut image = Image::black(SIZE, SIZE);
        let mut point = path.at(&Weights::two(0.0))?;
        let [mut before, mut now] = [ItpImage::default(), ItpImage::default()];
        let mut lengths = vec![0.0; PIECES + 1];
        for piece in 0..=PIECES {
            path.move_to(&Weights::two(piece as f32 / PIECES as f32), &mut point)?;
            sphere.render_into(point.as_ref(), &mut image);
            now.renew(&image, 1.0);
            if piece > 0 {
                lengths[piece] = lengths[piece - 1] + now.distance(&before, sphere.covered());
            }
            std::mem::swap(&mut before, &mut now);
        }
        let whole = lengths[PIECES];
        // A path at rest has any pace.
        let share =
            |(piece, length): (usize, f64)| if whole > 0.0 { length / whole } else { piece as f64 / PIECES as f64 };
        Ok(Self { shares: lengths.into_iter().enumerate().map(share).collect() })
    }

    /// The inner path's weights at a share of the length.
    fn set(&self, weights: &Weights) -> Result<Weights, PathError> {
        let share = f64::from(weights.for_ends(2)?[1]);
        if !share.is_finite() {
            // Refused by what it is used for.
            return Ok(weights.clone());
        }
        let pieces = PIECES as f64;
        let t = if share <= 0.0 {
            -beyond(-share, self.shares[1])
        } else if share >= 1.0 {
            1.0 + beyond(share - 1.0, 1.0 - self.shares[PIECES - 1])
        } else {
            let after = self.shares.partition_point(|&known| known < share).clamp(1, PIECES);
            let [low, high] = [self.shares[after - 1], self.shares[after]];
            // A piece at rest is passed at once.
            let within = if high > low { (share - low) / (high - low) } else { 1.0 };
            ((after - 1) as f64 + within.min(1.0)) / pieces
        };
        Ok(Weights::two(t as f32))
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
    use crate::library::builtin;
    use crate::metric::Smoothness;
    use crate::path::mix::Mix;

    fn ends() -> [Material; 2] {
        ["gold-paint", "blue-acrylic"].map(|name| builtin::shared().get(name).unwrap().material())
    }

    #[test]
    fn a_linear_mix_is_walked_at_an_even_pace() {
        let step_ratio = |interpolation: &dyn Interpolation| {
            let path = interpolation.between(&ends()).unwrap();
            let render =
                |step: u8| Sphere::studio().render(path.at(&Weights::two(f32::from(step) / 16.0)).unwrap().as_ref());
            let pictures: Vec<Image> = (0..=16).map(render).collect();
            Smoothness::of(&pictures, Sphere::studio().covered()).step_ratio
        };
        let plain = step_ratio(&Mix::Linear);
        let even = step_ratio(&Even::new("even", Box::new(Mix::Linear)));
        println!("step_ratio {plain:.3}, even {even:.3}");
        assert!(plain > 1.5 && even < 1.05, "{plain} {even}");
    }

    #[test]
    fn the_pace_at_an_end_goes_on_beyond_it() {
        for power in [0.5, 2.0] {
            let clock = Clock { shares: (0..=PIECES).map(|k| (k as f64 / PIECES as f64).powf(power)).collect() };
            let inner = |t: f32| f64::from(clock.set(&Weights::two(t)).unwrap().as_slice()[1]);
            for end in [0.0, 1.0] {
                let (before, after) = (inner(end) - inner(end - 2e-5), inner(end + 2e-5) - inner(end));
                assert!((before / after - 1.0).abs() < 0.1, "{power} at {end}: {before} {after}");
            }
        }
        assert!(Clock { shares: vec![0.0; PIECES + 1] }.set(&Weights::two(f32::NAN)).unwrap().as_slice()[1].is_nan());
    }

    #[test]
    fn the_ends_stay_the_ends() {
        let clock = Clock { shares: (0..=PIECES).map(|k| (k as f64 / PIECES as f64).powi(2)).collect() };
        let inner = |t: f32| clock.set(&Weights::two(t)).unwrap().as_slice()[1];
        assert_eq!((inner(0.0), inner(1.0)), (0.0, 1.0));
        assert!((inner(0.25) - 0.5).abs() < 1e-3);
        assert!(inner(-0.25) < 0.0 && inner(1.25) > 1.0);
    }

    proptest! {
        #[test]
        fn time_never_runs_backwards(lengths in prop::collection::vec(0.0..1.0f64, PIECES), a in -0.5..1.5f32, b in -0.5..1.5f32) {
            let whole: f64 = lengths.iter().sum::<f64>().max(1e-9);
            let mut shares = vec![0.0];
            shares.extend(lengths.iter().scan(0.0, |sum, length| { *sum += length / whole; Some(*sum) }));
            let clock = Clock { shares };
            let [a, b] = [a.min(b), a.max(b)].map(|t| clock.set(&Weights::two(t)).unwrap().as_slice()[1]);
            prop_assert!(a <= b && a.is_finite() && b.is_finite());
        }
    }
}
