//! A network bound to one kind of vectors, so that kinds stand side by side.

use crate::brdf::Prepared;
use crate::simd::InstructionSet;
use crate::{Brdf, Directions, Nbrdf, Rgb};

/// A network evaluated with this instruction set, whichever is the fastest.
pub struct WithSet {
    /// The network.
    pub network: Nbrdf,
    /// Its vectors.
    pub set: InstructionSet,
}

impl Brdf for WithSet {
    fn eval(&self, at: Directions) -> Rgb {
        let mut out = [Rgb::BLACK];
        self.eval_into(&[at], &mut out);
        out[0]
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.network.eval_with(self.set, at, out);
    }

    fn eval_prepared(&self, at: &Prepared, out: &mut [Rgb]) {
        self.network.eval_prepared_with(self.set, at, out);
    }
}
