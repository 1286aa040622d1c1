//! A microfacet lobe whose factors are tables: f = ρ_d + ρ_s D(θ_half) F(θ_diff) G(θ_i) G(θ_o) / (cos θ_i cos θ_o).
//!
//! M. Bagher, J. Snyder, D. Nowrouzezahrai, *A Non-Parametric Factor Microfacet Model for Isotropic BRDFs* (2016),
//! doi 10.1145/2907941: 90 entries per factor and channel, read by linear interpolation. D and F have their entries in the
//! middles of MERL's cells, θ_half spaced by the square root. Differs: G has its entries at whole degrees and is 0 at the
//! horizon, so that G / cos θ ends at a finite value where the paper's quotient does not.

use std::f32::consts::FRAC_PI_2;

use pulp::{Simd, WithSimd};

use super::places::{self, Placed};
use crate::nbrdf::kernel::half_diff;
use crate::simd::{InstructionSet, LANES, angle};
use crate::{Brdf, Directions, Rgb};

/// Entries of each factor.
pub const ENTRIES: usize = 90;
/// Entries of G and the zero at the horizon.
pub(crate) const NODES: usize = ENTRIES + 1;
/// Numbers below 0 are read as 0, those above as this: no product of them is infinite.
pub const LARGEST: f32 = 1e6;

/// G / cos θ of unit vectors stays far below, since G is 0 at the horizon.
const MOST: f32 = 1e9;

/// The numbers of one channel; those outside 0..=[`LARGEST`] are read as the nearest of these, NaN as 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Factors {
    /// ρ_d \[1/sr\], the same in all directions.
    pub diffuse: f32,
    /// ρ_s, the scale of the lobe.
    pub specular: f32,
    /// D at θ_half = π/2 ((k + ½)/90)², constant beyond the first and the last.
    pub distribution: [f32; ENTRIES],
    /// F at θ_diff = π/2 (k + ½)/90, constant beyond the first and the last.
    pub fresnel: [f32; ENTRIES],
    /// G at θ = π/2 k/90; 0 at θ = π/2.
    pub shadowing: [f32; ENTRIES],
}

/// Tables of three channels side by side, so that an entry is one load.
#[derive(Clone, Debug)]
pub struct Factored {
    diffuse: [f32; 4],
    /// ρ_s D.
    distribution: [[f32; 4]; ENTRIES],
    fresnel: [[f32; 4]; ENTRIES],
    /// G from the horizon to the normal.
    shadowing: [[f32; 4]; NODES],
}

impl Factored {
    /// From the factors of red, green and blue.
    pub fn new(channels: &[Factors; 3]) -> Self {
        // NaN is not above 0 either.
        let read = |number: f32| if number > 0.0 { number.min(LARGEST) } else { 0.0 };
        let entry = |of: &dyn Fn(&Factors) -> f32| {
            let [r, g, b] = channels.each_ref().map(|factors| read(of(factors)));
            [r, g, b, 0.0]
        };
        let specular = entry(&|factors| factors.specular);
        let mut factored = Self {
            diffuse: entry(&|factors| factors.diffuse),
            distribution: [[0.0; 4]; ENTRIES],
            fresnel: [[0.0; 4]; ENTRIES],
            shadowing: [[0.0; 4]; NODES],
        };
        for k in 0..ENTRIES {
            let distribution = entry(&|factors| factors.distribution[k]);
            factored.distribution[k] = std::array::from_fn(|channel| specular[channel] * distribution[channel]);
            factored.fresnel[k] = entry(&|factors| factors.fresnel[k]);
            factored.shadowing[ENTRIES - k] = entry(&|factors| factors.shadowing[k]);
        }
        factored
    }
}

#[inline(always)]
fn interpolated<const N: usize>(table: &[[f32; 4]; N], place: f32) -> [f32; 4] {
    let (low, t) = split::<N>(place);
    let [below, above] = [table[low], table[low + 1]];
    std::array::from_fn(|channel| below[channel] + t * (above[channel] - below[channel]))
}

/// The entry below a place among `N` and the weight of the one above.
#[inline(always)]
pub(crate) fn split<const N: usize>(place: f32) -> (usize, f32) {
    let low = (place as usize).min(N - 2);
    (low, place - low as f32)
}

impl Brdf for Factored {
    fn eval(&self, at: Directions) -> Rgb {
        places::read_one(self, at)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        places::read(self, at, out);
    }
}

/// Places in D, F, G(θ_i) and G(θ_o), in units of entries from the first, G from the horizon; and 1 / cos θ_i and 1 / cos θ_o.
impl Placed<6> for Factored {
    #[inline(always)]
    fn place<S: Simd>(simd: S, light: [S::f32s; 3], view: [S::f32s; 3]) -> [S::f32s; 6] {
        let constant = |v: f32| simd.splat_f32s(v);
        let across = |x, y| simd.sqrt_f32s(simd.mul_add_e_f32s(x, x, simd.mul_f32s(y, y)));
        let within = |place, last: usize| simd.max_f32s(simd.min_f32s(place, constant(last as f32)), constant(0.0));
        let middle = |share| {
            let place = simd.mul_add_e_f32s(constant(ENTRIES as f32), share, constant(-0.5));
            within(place, ENTRIES - 1)
        };
        // The angle above the horizon, since the one from the normal has no digits left where cos θ goes to 0.
        let height = |[x, y, z]: [S::f32s; 3]| {
            let share =
                simd.mul_f32s(angle(simd, simd.max_f32s(z, constant(0.0)), across(x, y)), constant(1.0 / FRAC_PI_2));
            within(simd.mul_f32s(constant(ENTRIES as f32), share), ENTRIES)
        };
        let [hx, hz, dx, dy, dz] = half_diff(simd, light, view);
        let half = simd.mul_f32s(angle(simd, hx, hz), constant(1.0 / FRAC_PI_2));
        let diff = simd.mul_f32s(angle(simd, across(dx, dy), dz), constant(1.0 / FRAC_PI_2));
        let over = |z| simd.div_f32s(constant(1.0), simd.max_f32s(z, constant(f32::MIN_POSITIVE)));
        [middle(simd.sqrt_f32s(half)), middle(diff), height(light), height(view), over(light[2]), over(view[2])]
    }

    #[inline(always)]
    fn read(&self, [half, diff, light, view, over_light, over_view]: [f32; 6]) -> Rgb {
        let distribution = interpolated(&self.distribution, half);
        let fresnel = interpolated(&self.fresnel, diff);
        let [light, view] = [light, view].map(|place| interpolated(&self.shadowing, place));
        Rgb(std::array::from_fn(|c| {
            // One side after the other: of unit vectors either is finite, and so is their product; of vectors that are none
            // it is kept so.
            let sides = (light[c] * over_light).min(MOST) * (view[c] * over_view).min(MOST);
            self.diffuse[c] + distribution[c] * fresnel[c] * sides
        }))
    }
}

/// Where pairs read D, F, G(θ_i) and G(θ_o), in units of entries from the first; G from the horizon.
pub(crate) fn places(at: &[Directions]) -> Vec<[f32; 4]> {
    struct Places<'a>(&'a [Directions]);

    impl WithSimd for Places<'_> {
        type Output = Vec<[f32; 4]>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let mut found = Vec::with_capacity(self.0.len());
            for at in self.0.chunks(LANES) {
                let [half, diff, light, view, ..] = places::block::<Factored, 6, S>(simd, at);
                let one = |lane: usize| [&half, &diff, &light, &view].map(|lanes| lanes.0[lane]);
                found.extend((0..at.len()).map(one));
            }
            found
        }
    }

    InstructionSet::fastest().run(Places(at))
}

#[cfg(test)]
mod tests;
