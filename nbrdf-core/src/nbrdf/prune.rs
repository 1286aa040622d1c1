//! Which hidden units can fire at all: the others are left out of evaluation, which does not change a bit of it.
//!
//! Trained relu networks keep units that are negative for every pair of directions (2.2 + 6.4 of 21 + 21 in the
//! published ones). That none of them ever fires is proved by branch and bound over (θ_half, θ_diff, φ_diff): a unit is
//! bounded from above on boxes (module `affine`), which are halved until it is below 0 on all of them or found to fire.
//! What cannot be decided within a budget counts as live. Zonotopes for relu networks: G. Singh et al., *Fast and
//! Effective Robustness Certification* (2018), section 3.

mod affine;
mod region;

use std::collections::VecDeque;

use super::kernel::{Activations, Block, Live, Packed};
use super::{Layout, Nbrdf};
use crate::brdf::Prepared;
use crate::sampling::rus32k;
use crate::simd::LANES;
use affine::Affine;
use region::Region;

/// Directions tried first: a unit that fires at one of them needs no proof.
const TRIED: usize = 2048;
/// Regions looked at per network.
const BUDGET: usize = 40_000;
/// A unit that is undecided on a region whose decisive half width is less \[rad\] comes so close to firing that it stays.
const SMALLEST: f64 = 2e-3;
/// How far computed network inputs may be from those of *some* region's exact unit vectors: rounding, and lengths within
/// 10⁻⁶ of 1. Which ones does not matter: near opposite light and view that is far from well-conditioned.
const INPUT_ERROR: f64 = 2e-6;
/// Rounding of one f32 operation, relative.
const UNIT_ROUNDOFF: f64 = 6e-8;
/// Well within the range of f32.
const LARGEST: f64 = 1e37;

impl Nbrdf {
    /// The same network, evaluated without inputs and units that never matter: bit for bit the same values for unit
    /// vectors (lengths within 10⁻⁶ of 1). Takes some milliseconds; [`weights`](Nbrdf::weights) stay whole.
    pub fn pruned(&self) -> Self {
        let packed = Packed::new(self.hidden, &self.weights, self.live());
        Self { hidden: self.hidden, weights: self.weights.clone(), packed }
    }

    /// What is evaluated: everything, or what [`pruned`](Self::pruned) left.
    pub const fn evaluated(&self) -> &Live {
        self.packed.live()
    }

    /// What of this network can ever matter for isotropic materials, whose h.y is 0; known of a [`pruned`](Self::pruned)
    /// one, else proved.
    pub fn live(&self) -> Live {
        if !self.evaluated().is_all(self.hidden) {
            return self.evaluated().clone();
        }
        let dead = prove(self, self.silent());
        let units = [0, 1].map(|layer| (0..self.hidden[layer]).filter(|unit| !dead[layer].contains(unit)).collect());
        Live { half_y: false, units }
    }

    /// Units of both layers that fire at none of some directions.
    fn silent(&self) -> [Vec<usize>; 2] {
        let all = rus32k();
        let at = Prepared::new(all.iter().step_by(all.len() / TRIED).copied().collect());
        let mut activations = Activations::EMPTY;
        activations.resize(self.hidden);
        let packed = Packed::new(self.hidden, &self.weights, Live::all(self.hidden));
        let mut fires = self.hidden.map(|width| vec![false; width]);
        for (index, Block { inputs, .. }) in at.blocks().iter().enumerate() {
            // Unused lanes of the last block are no directions.
            let lanes = (at.len() - index * LANES).min(LANES);
            activations.forward(pulp::Scalar::new(), &packed, inputs);
            for (fires, layer) in fires.iter_mut().zip([&activations.first, &activations.second]) {
                for (fires, unit) in fires.iter_mut().zip(layer) {
                    *fires |= unit.0[..lanes].iter().any(|&v| v > 0.0);
                }
            }
        }
        fires.map(|fires| (0..fires.len()).filter(|&unit| !fires[unit]).collect())
    }
}

/// Those of `candidates` that never fire.
fn prove(network: &Nbrdf, mut candidates: [Vec<usize>; 2]) -> [Vec<usize>; 2] {
    let bounds = Bounds::new(network);
    // Breadth first: units that are easily decided are, before the budget is spent on the others.
    let mut queue = VecDeque::from([(Region::WHOLE, candidates.clone())]);
    for _ in 0..BUDGET {
        let Some((region, undecided)) = queue.pop_front() else { break };
        let units = intersection(&undecided, &candidates);
        if units.iter().all(Vec::is_empty) || !region.is_valid_somewhere() {
            continue;
        }
        let bounded = bounds.of(&region, &units);
        let mut left = [Vec::new(), Vec::new()];
        let mut reach = [0.0; 3];
        for layer in 0..2 {
            for (&unit, bound) in units[layer].iter().zip(&bounded[layer]) {
                // Also where the bound is not a number: the weights are too large to tell.
                let is_silent = bound.upper() <= 0.0;
                let fires = bound.centre > 0.0 && region.centre_is_valid();
                if fires {
                    candidates[layer].retain(|&candidate| candidate != unit);
                } else if !is_silent {
                    left[layer].push(unit);
                    (0..3).for_each(|angle| reach[angle] += bound.reach_along(angle));
                }
            }
        }
        if left.iter().any(|units| !units.is_empty()) {
            let widest = (0..3).max_by(|&a, &b| reach[a].total_cmp(&reach[b])).unwrap_or(0);
            if region.half_width(widest) < SMALLEST {
                for (left, candidates) in left.iter().zip(&mut candidates) {
                    candidates.retain(|unit| !left.contains(unit));
                }
            } else {
                queue.extend(region.halves(widest).map(|half| (half, left.clone())));
            }
        }
    }
    // What is undecided somewhere is not proved.
    for (_, undecided) in queue {
        for (undecided, candidates) in undecided.iter().zip(&mut candidates) {
            candidates.retain(|unit| !undecided.contains(unit));
        }
    }
    candidates
}

fn intersection(a: &[Vec<usize>; 2], b: &[Vec<usize>; 2]) -> [Vec<usize>; 2] {
    [0, 1].map(|layer| a[layer].iter().copied().filter(|unit| b[layer].contains(unit)).collect())
}

/// The network's first two layers in f64: weights of each unit, bias last.
struct Bounds([Vec<Vec<f64>>; 2]);

impl Bounds {
    fn new(network: &Nbrdf) -> Self {
        let [first, second, _] = Layout::new(network.hidden).layers;
        Self([first, second].map(|(kernel, bias)| {
            let (kernel, bias) = (&network.weights[kernel], &network.weights[bias]);
            let unit = |j: usize| kernel.iter().skip(j).step_by(bias.len()).chain([&bias[j]]).map(|&w| w.into());
            (0..bias.len()).map(|j| unit(j).collect()).collect()
        }))
    }

    /// Bounds of the pre-activations of these units as they are computed: what f32 rounding may add is in them.
    fn of(&self, region: &Region, units: &[Vec<usize>; 2]) -> [Vec<Affine>; 2] {
        let inputs = region.inputs().map(|input| input.widened(INPUT_ERROR));
        let [first, second] = &self.0;
        let first: Vec<Affine> = first.iter().map(|weights| computed(weights, &inputs)).collect();
        let asked = units[0].iter().map(|&unit| first[unit]).collect();
        if units[1].is_empty() {
            return [asked, Vec::new()];
        }
        let fired: Vec<Affine> = first.iter().map(Affine::relu).collect();
        [asked, units[1].iter().map(|&unit| computed(&second[unit], &fired)).collect()]
    }
}

/// bias + Σ weight · input with what a chain of f32 multiply-adds may be off.
fn computed(weights: &[f64], inputs: &[Affine]) -> Affine {
    let (&bias, kernel) = weights.split_last().unwrap_or((&0.0, &[]));
    let size = bias.abs() + kernel.iter().zip(inputs).map(|(w, x)| w.abs() * x.largest()).sum::<f64>();
    // Sums that may leave the range of f32 have no bound.
    let rounding = if size < LARGEST { (inputs.len() + 1) as f64 * UNIT_ROUNDOFF * size } else { f64::INFINITY };
    Affine::weighted_sum(bias, kernel, inputs).widened(rounding)
}

#[cfg(test)]
mod tests;
