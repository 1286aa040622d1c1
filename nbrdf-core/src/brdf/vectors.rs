//! Formulas written for vectors of pairs, evaluated block by block.

use pulp::{Simd, WithSimd};

use super::pairs::{Pairs, where_above};
use crate::simd::{InstructionSet, LANES, Lanes};
use crate::{Directions, Rgb};

/// A reflectance as a formula over vectors of pairs.
pub(super) trait Formula {
    /// f_r \[1/sr\] of every lane, red, green, blue, for light and view above the surface.
    fn vector<S: Simd>(&self, simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 3];
}

/// The formula at every pair; black below the horizon.
///
/// # Panics
/// If `at` and `out` differ in length (a bug of the caller).
pub(super) fn evaluate(formula: &impl Formula, at: &[Directions], out: &mut [Rgb]) {
    assert_eq!(at.len(), out.len(), "one output per pair of directions");
    InstructionSet::fastest().run(Evaluate { formula, at, out });
}

/// One pair by the same instructions: the same bits alone as among others.
pub(super) fn evaluate_one(formula: &impl Formula, at: Directions) -> Rgb {
    let mut out = [Rgb::BLACK];
    evaluate(formula, &[at], &mut out);
    out[0]
}

struct Evaluate<'a, F> {
    formula: &'a F,
    at: &'a [Directions],
    out: &'a mut [Rgb],
}

impl<F: Formula> WithSimd for Evaluate<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (at, out) in self.at.chunks(LANES).zip(self.out.chunks_mut(LANES)) {
            let pairs = Pairs::load(at);
            let mut values = [Lanes::ZERO; 3];
            // A pair alone fills one vector, not the block.
            for i in 0..at.len().div_ceil(S::F32_LANES) {
                let [light, view] = pairs.vectors::<S>(i);
                let found = self.formula.vector(simd, light, view);
                for (lanes, value) in values.iter_mut().zip(found) {
                    lanes.vectors_mut::<S>()[i] = where_above(simd, light[2], view[2], value);
                }
            }
            for (lane, out) in out.iter_mut().enumerate() {
                *out = Rgb([values[0].0[lane], values[1].0[lane], values[2].0[lane]]);
            }
        }
    }
}

/// The half vector of light and view in what formulas read of it.
pub(super) struct Half<S: Simd> {
    /// tan² θ_half.
    pub tan2: S::f32s,
    /// cos θ_half.
    pub cos: S::f32s,
    /// 1 − cos θ_half, of small relative error.
    pub versine: S::f32s,
    /// cos θ_diff, 0..1.
    pub cos_diff: S::f32s,
}

impl<S: Simd> Half<S> {
    /// From unit vectors above the surface: s = l + v is 2 cos θ_diff long.
    #[inline(always)]
    pub fn of(simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> Self {
        let constant = |v: f32| simd.splat_f32s(v);
        let [sx, sy, sz] = [0, 1, 2].map(|axis| simd.add_f32s(light[axis], view[axis]));
        // Far below what f32 directions resolve, and its square is still a number.
        let sz = simd.max_f32s(sz, constant(1e-9));
        let across = simd.mul_add_e_f32s(sx, sx, simd.mul_f32s(sy, sy));
        let up = simd.mul_f32s(sz, sz);
        let length = simd.sqrt_f32s(simd.add_f32s(across, up));
        Self {
            tan2: simd.div_f32s(across, up),
            cos: simd.div_f32s(sz, length),
            versine: simd.div_f32s(across, simd.mul_f32s(length, simd.add_f32s(length, sz))),
            cos_diff: simd.min_f32s(simd.mul_f32s(constant(0.5), length), constant(1.0)),
        }
    }
}

/// ln(1 + t) for t ≥ 0, of small relative error also near 0 (D. Goldberg, *What Every Computer Scientist Should Know
/// About Floating-Point Arithmetic*, 1991, theorem 4).
#[inline(always)]
pub(super) fn ln_one_plus<S: Simd>(simd: S, t: S::f32s) -> S::f32s {
    let one = simd.splat_f32s(1.0);
    let x = simd.add_f32s(one, t);
    let rounded = simd.sub_f32s(x, one);
    let is_lost = simd.greater_than_f32s(simd.splat_f32s(1e-7), rounded);
    let scaled = simd.mul_f32s(crate::simd::ln(simd, x), simd.div_f32s(t, rounded));
    simd.select_f32s(is_lost, t, scaled)
}
