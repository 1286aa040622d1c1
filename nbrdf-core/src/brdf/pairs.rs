//! Pairs of directions, lanes side by side.

use pulp::Simd;

use crate::Directions;
use crate::simd::{LANES, Lanes};

/// Light and view of a block of pairs.
pub(crate) struct Pairs {
    light: [Lanes; 3],
    view: [Lanes; 3],
}

impl Pairs {
    /// Of 1 to [`LANES`] pairs; unused lanes repeat the last one.
    #[inline(always)]
    pub fn load(pairs: &[Directions]) -> Self {
        let mut loaded = Self { light: [Lanes::ZERO; 3], view: [Lanes::ZERO; 3] };
        match <&[Directions; LANES]>::try_from(pairs) {
            Ok(full) => {
                for (lane, at) in full.iter().enumerate() {
                    loaded.put(lane, *at);
                }
            }
            Err(_) => {
                for lane in 0..LANES {
                    loaded.put(lane, pairs[lane.min(pairs.len() - 1)]);
                }
            }
        }
        loaded
    }

    #[inline(always)]
    fn put(&mut self, lane: usize, at: Directions) {
        for axis in 0..3 {
            self.light[axis].0[lane] = at.light[axis];
            self.view[axis].0[lane] = at.view[axis];
        }
    }

    /// x, y and z of the lights and of the views of one vector of pairs.
    #[inline(always)]
    pub fn vectors<S: Simd>(&self, index: usize) -> [[S::f32s; 3]; 2] {
        [self.light.each_ref().map(|l| l.vectors::<S>()[index]), self.view.each_ref().map(|l| l.vectors::<S>()[index])]
    }
}

/// Bit `lane` is set where both directions are above the surface.
#[inline(always)]
pub(crate) fn above(pairs: &[Directions]) -> u32 {
    let mut mask = 0;
    for (lane, at) in pairs.iter().enumerate() {
        mask |= u32::from(at.is_above()) << lane;
    }
    mask
}

/// Where both directions are above the surface `value`, elsewhere 0.
#[inline(always)]
pub(crate) fn where_above<S: Simd>(simd: S, light_z: S::f32s, view_z: S::f32s, value: S::f32s) -> S::f32s {
    let zero = simd.splat_f32s(0.0);
    let lit = simd.select_f32s(simd.greater_than_f32s(light_z, zero), value, zero);
    simd.select_f32s(simd.greater_than_f32s(view_z, zero), lit, zero)
}
