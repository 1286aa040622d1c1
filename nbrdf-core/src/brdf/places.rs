//! Tables that are looked up where vectors of pairs say, block by block.

use pulp::{Simd, WithSimd};

use super::pairs::{Pairs, above};
use crate::simd::{InstructionSet, LANES, Lanes};
use crate::{Directions, Rgb};

/// Numbers that are read at places, each found from a pair by `N` numbers.
pub(super) trait Placed<const N: usize> {
    /// What every lane is looked up by.
    fn place<S: Simd>(simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; N];

    /// f_r \[1/sr\] there, for light and view above the surface.
    fn read(&self, place: [f32; N]) -> Rgb;
}

/// What is read at every pair; black below the horizon.
///
/// # Panics
/// If `at` and `out` differ in length (a bug of the caller).
pub(super) fn read<const N: usize>(table: &impl Placed<N>, at: &[Directions], out: &mut [Rgb]) {
    assert_eq!(at.len(), out.len(), "one output per pair of directions");
    InstructionSet::fastest().run(Read { table, at, out });
}

/// One pair by the same instructions.
pub(super) fn read_one<const N: usize>(table: &impl Placed<N>, at: Directions) -> Rgb {
    let mut out = [Rgb::BLACK];
    read(table, &[at], &mut out);
    out[0]
}

struct Read<'a, T, const N: usize> {
    table: &'a T,
    at: &'a [Directions],
    out: &'a mut [Rgb],
}

impl<T: Placed<N>, const N: usize> WithSimd for Read<'_, T, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (at, out) in self.at.chunks(LANES).zip(self.out.chunks_mut(LANES)) {
            let places = block::<T, N, S>(simd, at);
            let above = above(at);
            for (lane, out) in out.iter_mut().enumerate() {
                // What is not a number, of vectors that are none, is read at 0.
                let place = places.each_ref().map(|lanes| lanes.0[lane].max(0.0));
                *out = if (above >> lane) & 1 == 1 { self.table.read(place) } else { Rgb::BLACK };
            }
        }
    }
}

/// The places of one block of pairs.
#[inline(always)]
pub(super) fn block<T: Placed<N>, const N: usize, S: Simd>(simd: S, at: &[Directions]) -> [Lanes; N] {
    let pairs = Pairs::load(at);
    let mut places = [Lanes::ZERO; N];
    for i in 0..LANES / S::F32_LANES {
        let [light, view] = pairs.vectors::<S>(i);
        for (lanes, place) in places.iter_mut().zip(T::place(simd, light, view)) {
            lanes.vectors_mut::<S>()[i] = place;
        }
    }
    places
}
