//! Blocks of directions: one number for each of them, side by side.

use pulp::Simd;

/// Directions per block: two vectors of AVX-512, four of AVX2.
pub(crate) const LANES: usize = 32;

/// One number for each direction of a block, aligned so that no vector straddles a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Lanes(pub [f32; LANES]);

impl Lanes {
    pub const ZERO: Self = Self([0.0; LANES]);

    /// The block as vectors of the processor.
    #[inline(always)]
    pub fn vectors<S: Simd>(&self) -> &[S::f32s] {
        S::as_simd_f32s(&self.0).0
    }

    /// The block as vectors of the processor, to be written.
    #[inline(always)]
    pub fn vectors_mut<S: Simd>(&mut self) -> &mut [S::f32s] {
        S::as_mut_simd_f32s(&mut self.0).0
    }
}
