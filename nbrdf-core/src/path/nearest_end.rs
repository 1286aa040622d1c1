//! Doing nothing: the nearest end. A method worse than this is worse than doing nothing.

use std::sync::Arc;

use super::{Interpolation, Path, PathError, Weights, at_least_two};
use crate::{Brdf, Directions, Material, Rgb};

/// Jumps to the end with the largest weight; the first of equals.
pub struct NearestEnd;

impl Interpolation for NearestEnd {
    fn name(&self) -> &'static str {
        "nearest_end"
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        at_least_two(ends)?;
        Ok(Box::new(Ends(ends.iter().map(|end| Arc::clone(&end.brdf)).collect())))
    }
}

struct Ends(Vec<Arc<dyn Brdf>>);

impl Path for Ends {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        let weights = weights.for_ends(self.0.len())?;
        let mut nearest = 0;
        for (index, weight) in weights.iter().enumerate() {
            if *weight > weights[nearest] {
                nearest = index;
            }
        }
        Ok(Box::new(Shared(Arc::clone(&self.0[nearest]))))
    }
}

/// A shared reflectance where an owned one is asked for.
struct Shared(Arc<dyn Brdf>);

impl Brdf for Shared {
    fn eval(&self, at: Directions) -> Rgb {
        self.0.eval(at)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.0.eval_into(at, out);
    }

    fn eval_signed_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.0.eval_signed_into(at, out);
    }
}
