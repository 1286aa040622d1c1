//! Any path walked at an even pace, as it is seen: equal steps of t are equal steps of ΔE_ITP.

use super::clock::Clock;
use super::{Interpolation, Path, PathError, Weights};
use crate::{Brdf, Code, Material, Warning};

/// Another interpolation, re-timed between two ends by the length of its path under light `studio`. Beyond the ends it
/// goes on at the pace it has there; a pace above the plain one fades to that. Weights of three ends and more are no
/// time: such paths stay as they are, and whoever walks them along a spline asks a [`Clock`].
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
        let clock = Clock::of(path.as_ref(), 2)?;
        Ok(Box::new(EvenPath { path, clock }))
    }
}

struct EvenPath {
    path: Box<dyn Path>,
    clock: Clock,
}

impl Path for EvenPath {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        self.path.at(&self.set(weights)?)
    }

    fn code(&self, weights: &Weights) -> Result<Option<Code>, PathError> {
        self.path.code(&self.set(weights)?)
    }

    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        self.path.move_to(&self.set(weights)?, point)
    }

    fn warnings(&self, weights: &Weights) -> Result<Vec<Warning>, PathError> {
        self.path.warnings(&self.set(weights)?)
    }
}

impl EvenPath {
    /// The inner path's weights at a share of the length.
    fn set(&self, weights: &Weights) -> Result<Weights, PathError> {
        Ok(Weights::two(self.clock.set(weights.for_ends(2)?[1])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Image;
    use crate::library::builtin;
    use crate::metric::Smoothness;
    use crate::path::mix::Mix;
    use crate::render::Sphere;

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
}
