//! Any path, with a limit beyond its ends: no material there reflects more light than it receives (or than the end).
//!
//! x beyond an end becomes r (1 − e^(−x/r)): at the end the path goes on as it came, without a kink, then ever slower,
//! and never further than its reach r. The reach is where albedo [`LIMIT`] is met, [`FURTHEST`] at most; an end without
//! reach is not left. Points stay points of the inner path (decoded codes stay networks); derivatives by t fade, but
//! where there is reach they nowhere vanish or jump.
//!
//! Between three ends and more, x is the sum of the negative weights. Splines have some (1/8 at most); what they ask for is
//! shortened by less than x² / 2r, under 0.008 of the span of the ends where nothing is too bright.

use std::sync::OnceLock;

use smallvec::SmallVec;

use super::{Interpolation, Path, PathError, Weights};
use crate::metric::albedo_max;
use crate::{Brdf, Code, Material, Warning};

/// Albedo that is not exceeded beyond the ends.
const LIMIT: f64 = 0.99;
/// Reach where nothing else limits it, in distances of the ends.
const FURTHEST: f32 = 1.0;
/// Places at which a reach is looked for, and halvings afterwards.
const LOOKS: u8 = 16;
const HALVINGS: u8 = 4;

/// Share of the way where nothing is too bright below which it counts as clamped.
const CLAMPED: f32 = 0.99;

/// Another interpolation, limited beyond its ends; between them nothing changes.
pub struct Bounded {
    inner: Box<dyn Interpolation>,
}

impl Bounded {
    /// Under the inner one's name.
    pub fn new(inner: Box<dyn Interpolation>) -> Self {
        Self { inner }
    }
}

impl Interpolation for Bounded {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        let path = self.inner.between(ends)?;
        Ok(Box::new(BoundedPath { path, ends: ends.len(), reach: Default::default() }))
    }
}

struct BoundedPath {
    path: Box<dyn Path>,
    ends: usize,
    /// Beyond the first and the second of two ends; looked for when first needed.
    reach: [OnceLock<f32>; 2],
}

impl Path for BoundedPath {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        self.path.at(&self.limited(weights)?)
    }

    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        self.path.move_to(&self.limited(weights)?, point)
    }

    fn code(&self, weights: &Weights) -> Result<Option<Code>, PathError> {
        self.path.code(&self.limited(weights)?)
    }

    fn warnings(&self, weights: &Weights) -> Result<Vec<Warning>, PathError> {
        let (asked, kept) = (weights.beyond(), self.limited(weights)?.beyond());
        let is_clamped = kept < CLAMPED * slowed(asked, FURTHEST);
        let clamped = is_clamped.then_some(Warning::EnergyClamped { asked, kept });
        Ok(weights.warning().map(|beyond| clamped.unwrap_or(beyond)).into_iter().collect())
    }
}

impl BoundedPath {
    fn limited(&self, weights: &Weights) -> Result<Weights, PathError> {
        let asked = weights.for_ends(self.ends)?;
        let beyond: f32 = asked.iter().map(|w| (-w).max(0.0)).sum();
        if beyond == 0.0 || !beyond.is_finite() {
            return Ok(weights.clone());
        }
        let ray = Ray::new(asked, beyond);
        let reach = match asked {
            [first, _] => self.known_reach(usize::from(*first < 0.0), &ray)?,
            _ => self.reach_along(&ray)?,
        };
        Ok(ray.at(slowed(beyond, reach)))
    }

    /// Beyond one of two ends: looked for once.
    fn known_reach(&self, side: usize, ray: &Ray) -> Result<f32, PathError> {
        if let Some(&known) = self.reach[side].get() {
            return Ok(known);
        }
        let found = self.reach_along(ray)?;
        Ok(*self.reach[side].get_or_init(|| found))
    }

    /// How far the albedo stays within its limit.
    fn reach_along(&self, ray: &Ray) -> Result<f32, PathError> {
        let mut point = self.path.at(&ray.at(0.0))?;
        let mut is_safe = |x: f32| {
            // Where nothing can be decoded, nothing is safe.
            self.path.move_to(&ray.at(x), &mut point).is_ok() && albedo_max(point.as_ref()) <= LIMIT
        };
        let place = |look: u8| FURTHEST * f32::from(look) / f32::from(LOOKS);
        let mut look = 0;
        while look <= LOOKS && is_safe(place(look)) {
            look += 1;
        }
        if look > LOOKS {
            return Ok(FURTHEST);
        }
        let Some(last) = look.checked_sub(1) else { return Ok(0.0) };
        let (mut safe, mut unsafe_) = (place(last), place(look));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (safe + unsafe_);
            if is_safe(middle) { safe = middle } else { unsafe_ = middle }
        }
        Ok(safe)
    }
}

/// How far a walk gets that asks for `beyond`.
fn slowed(beyond: f32, reach: f32) -> f32 {
    if reach > 0.0 { -reach * (-beyond / reach).exp_m1() } else { 0.0 }
}

/// From the nearest mix of the ends outwards, by the sum of the negative weights.
struct Ray {
    base: SmallVec<[f32; 6]>,
    outwards: SmallVec<[f32; 6]>,
}

impl Ray {
    /// Through weights of which some are negative, `beyond` in all.
    fn new(asked: &[f32], beyond: f32) -> Self {
        let kept: f32 = asked.iter().map(|w| w.max(0.0)).sum();
        let base: SmallVec<[f32; 6]> = asked.iter().map(|w| w.max(0.0) / kept).collect();
        // (w − base) / beyond without the difference, of which nothing would be left near an end.
        let outwards = asked.iter().zip(&base).map(|(&w, &base)| if w < 0.0 { w / beyond } else { base }).collect();
        Self { base, outwards }
    }

    fn at(&self, x: f32) -> Weights {
        Weights::summing_to_one(self.base.iter().zip(&self.outwards).map(|(base, out)| base + x * out).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::lambert::Lambert;
    use crate::path::mix::Mix;
    use crate::{Interpolation, Rgb};

    fn greys(albedos: &[f32]) -> Vec<Material> {
        let one = |&albedo: &f32| Material::new("grey", std::sync::Arc::new(Lambert { albedo: Rgb::splat(albedo) }));
        albedos.iter().map(one).collect()
    }

    fn albedo(path: &dyn Path, weights: &Weights) -> f32 {
        let at = crate::Directions::from_angles(0.2, 0.0, 0.3, 1.0);
        path.at(weights).unwrap().eval(at)[0] * std::f32::consts::PI
    }

    #[test]
    fn between_the_ends_nothing_changes() {
        let bounded = Bounded::new(Box::new(Mix::Linear)).between(&greys(&[0.2, 0.8])).unwrap();
        for t in [0.0, 0.25, 1.0] {
            assert!((albedo(bounded.as_ref(), &Weights::two(t)) - (0.2 + 0.6 * t)).abs() < 1e-6);
        }
    }

    #[test]
    fn beyond_the_ends_the_walk_slows_down_and_stays_possible() {
        let bounded = Bounded::new(Box::new(Mix::Linear)).between(&greys(&[0.2, 0.8])).unwrap();
        let at = |t: f32| albedo(bounded.as_ref(), &Weights::two(t));
        let places: Vec<f32> = (0..=32).map(|k| at(1.0 + k as f32 / 8.0)).collect();
        assert!(places.windows(2).all(|pair| pair[1] >= pair[0]), "{places:?}");
        assert!(places[32] <= LIMIT as f32 && places[32] > 0.95, "{places:?}");
        // No kink at the end.
        let (before, after) = (at(1.0) - at(0.999), at(1.001) - at(1.0));
        assert!((before / after - 1.0).abs() < 0.05, "{before} {after}");
        assert!(at(-5.0) >= 0.0);
    }

    #[test]
    fn more_than_two_ends_have_a_limit_too() {
        let bounded = Bounded::new(Box::new(Mix::Linear)).between(&greys(&[0.2, 0.5, 0.9])).unwrap();
        let weights = Weights::normalized(vec![-1.0, -1.0, 3.0]).unwrap();
        let found = albedo(bounded.as_ref(), &weights);
        assert!(found > 0.9 && found <= LIMIT as f32, "{found}");
    }

    #[test]
    fn the_first_point_asked_for_changes_no_later_one() {
        let bounded = || Bounded::new(Box::new(Mix::Linear)).between(&greys(&[0.2, 0.8])).unwrap();
        for (near, far) in [(-1e-8, -0.5), (-1e-30, -0.5), (1.0 + f32::EPSILON, 1.5)] {
            let [fresh, used] = [bounded(), bounded()];
            let found = albedo(used.as_ref(), &Weights::two(near));
            assert!((found - (0.2 + 0.6 * near)).abs() < 1e-5, "{near}: {found}");
            let [fresh, used] = [fresh, used].map(|path| albedo(path.as_ref(), &Weights::two(far)));
            assert_eq!(used, fresh, "after {near}");
        }
    }

    #[test]
    fn a_spline_keeps_nearly_to_its_curve() {
        let ends = greys(&[0.2, 0.6, 0.3, 0.5]);
        let bounded = Bounded::new(Box::new(Mix::Linear)).between(&ends).unwrap();
        let plain = Mix::Linear.between(&ends).unwrap();
        for step in 0..=60u8 {
            let weights = Weights::along_spline(f32::from(step) / 60.0, 4);
            let [found, wanted] = [&bounded, &plain].map(|path| albedo(path.as_ref(), &weights));
            assert!((found - wanted).abs() < 0.008 * (0.6 - 0.2), "{step}: {found} {wanted}");
        }
    }

    #[test]
    fn a_walk_that_is_held_back_says_so() {
        let bounded = Bounded::new(Box::new(Mix::Linear)).between(&greys(&[0.2, 0.8])).unwrap();
        let kinds =
            |t: f32| -> Vec<&str> { bounded.warnings(&Weights::two(t)).unwrap().iter().map(Warning::kind).collect() };
        assert!(kinds(0.0).is_empty() && kinds(0.7).is_empty());
        // Towards black nothing is in the way; towards white there is.
        assert_eq!((kinds(-0.2), kinds(1.5)), (vec!["extrapolated"], vec!["energy_clamped"]));
    }

    #[test]
    fn an_end_at_the_limit_is_not_left() {
        let bounded = Bounded::new(Box::new(Mix::Linear)).between(&greys(&[0.2, 0.995])).unwrap();
        assert!((albedo(bounded.as_ref(), &Weights::two(1.5)) - 0.995).abs() < 1e-6);
    }
}
