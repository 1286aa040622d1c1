//! What can be done to a network's weights without changing its function: hidden units have no order, and a relu unit
//! has no scale. Used to align networks before their weights are mixed, and to test what must not depend on either.

use pathfinding::kuhn_munkres::kuhn_munkres;
use pathfinding::matrix::Matrix;

use super::kernel::{Activations, Live, Packed};
use super::samples::{SampleCounts, Samples};
use super::{INPUTS, Layout, Nbrdf};
use crate::nbrdf::fit::generator;
use crate::simd::LANES;

/// Reorders the hidden units: unit `i` of layer `l` becomes what was unit `order[l][i]`. The function stays the same.
///
/// # Panics
/// If an order is no permutation of its layer's units (a bug of the caller).
pub fn permute(network: &Nbrdf, order: [&[usize]; 2]) -> Nbrdf {
    let hidden = network.hidden();
    let [(k1, b1), (k2, b2), (k3, b3)] = Layout::new(hidden).layers;
    let old = network.weights();
    let mut new = old.to_vec();
    for to in 0..hidden[0] {
        let from = order[0][to];
        new[b1.start + to] = old[b1.start + from];
        for row in 0..INPUTS {
            new[k1.start + row * hidden[0] + to] = old[k1.start + row * hidden[0] + from];
        }
    }
    for to in 0..hidden[1] {
        let from = order[1][to];
        new[b2.start + to] = old[b2.start + from];
        for row in 0..hidden[0] {
            new[k2.start + row * hidden[1] + to] = old[k2.start + order[0][row] * hidden[1] + from];
        }
        for channel in 0..3 {
            new[k3.start + 3 * to + channel] = old[k3.start + 3 * from + channel];
        }
    }
    debug_assert_eq!(b3.end, new.len());
    Nbrdf::of_valid(hidden, new)
}

/// Multiplies what enters each hidden unit by a positive factor and divides what leaves it. The function stays the same.
///
/// # Panics
/// If there are fewer factors than units (a bug of the caller).
pub fn rescale(network: &Nbrdf, factors: [&[f32]; 2]) -> Nbrdf {
    let hidden = network.hidden();
    let [(k1, b1), (k2, b2), (k3, _)] = Layout::new(hidden).layers;
    let mut weights = network.weights().to_vec();
    for unit in 0..hidden[0] {
        let factor = factors[0][unit];
        weights[b1.start + unit] *= factor;
        (0..INPUTS).for_each(|row| weights[k1.start + row * hidden[0] + unit] *= factor);
        (0..hidden[1]).for_each(|column| weights[k2.start + unit * hidden[1] + column] /= factor);
    }
    for unit in 0..hidden[1] {
        let factor = factors[1][unit];
        weights[b2.start + unit] *= factor;
        (0..hidden[0]).for_each(|row| weights[k2.start + row * hidden[1] + unit] *= factor);
        (0..3).for_each(|channel| weights[k3.start + 3 * unit + channel] /= factor);
    }
    Nbrdf::of_valid(hidden, weights)
}

/// Gives every hidden unit incoming and outgoing weights of equal norm; the function stays the same.
pub fn balance(network: &Nbrdf) -> Nbrdf {
    let mut network = network.clone();
    // Balancing one layer disturbs the other a little; a few rounds settle it.
    for _ in 0..8 {
        let hidden = network.hidden();
        let [(k1, b1), (k2, b2), (k3, _)] = Layout::new(hidden).layers;
        let w = &network.weights;
        let norm = |values: &mut dyn Iterator<Item = f32>| values.map(|v| v * v).sum::<f32>().sqrt();
        let factor = |incoming: f32, outgoing: f32| {
            let factor = (outgoing / incoming).sqrt();
            if factor.is_finite() && factor > 1e-3 { factor.min(1e3) } else { 1.0 }
        };
        let first: Vec<f32> = (0..hidden[0])
            .map(|unit| {
                let column = (0..INPUTS).map(|row| w[k1.start + row * hidden[0] + unit]);
                let row = w[k2.start + unit * hidden[1]..][..hidden[1]].iter().copied();
                factor(norm(&mut column.chain([w[b1.start + unit]])), norm(&mut row.into_iter()))
            })
            .collect();
        let second: Vec<f32> = (0..hidden[1])
            .map(|unit| {
                let column = (0..hidden[0]).map(|row| w[k2.start + row * hidden[1] + unit]);
                let row = w[k3.start + 3 * unit..][..3].iter().copied();
                factor(norm(&mut column.chain([w[b2.start + unit]])), norm(&mut row.into_iter()))
            })
            .collect();
        network = rescale(&network, [&first, &second]);
    }
    network
}

/// Balances `network` and reorders its hidden units so that they do what those of `reference` do.
///
/// Units are matched by how their activations agree over sampled directions (S. Ainsworth et al., *Git Re-Basin*, 2023,
/// section 3.1), one layer after the other. Networks of different widths come back only balanced.
pub fn align(network: &Nbrdf, reference: &Nbrdf) -> Nbrdf {
    let network = balance(network);
    if network.hidden() != reference.hidden() {
        return network;
    }
    let own = activations(&network);
    let wanted = activations(&balance(reference));
    let orders: [Vec<usize>; 2] = std::array::from_fn(|layer| best_order(&own[layer], &wanted[layer]));
    permute(&network, [&orders[0], &orders[1]])
}

/// For every unit wanted, the own unit that agrees best, no unit used twice.
fn best_order(own: &[Vec<f32>], wanted: &[Vec<f32>]) -> Vec<usize> {
    let agreement = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| f64::from(a * b)).sum::<f64>();
    let table: Vec<Vec<f64>> =
        wanted.iter().map(|wanted| own.iter().map(|own| agreement(wanted, own)).collect()).collect();
    let largest = table.iter().flatten().fold(1e-12f64, |max, v| max.max(v.abs()));
    let units = own.len();
    let scaled = table.iter().flatten().map(|v| (v / largest * 1e12) as i64).collect();
    match Matrix::from_vec(units, units, scaled) {
        Ok(matrix) => kuhn_munkres(&matrix).1,
        Err(_) => (0..units).collect(),
    }
}

/// Activations of both hidden layers, one list per unit.
fn activations(network: &Nbrdf) -> [Vec<Vec<f32>>; 2] {
    let counts = SampleCounts { log: 2048, relative: 0, pixels: 0, lamps: 0 };
    let samples = Samples::random(&mut generator(1, 3), counts);
    let mut units = network.hidden().map(|width| vec![Vec::with_capacity(2048); width]);
    let mut activations = Activations::EMPTY;
    activations.resize(network.hidden());
    let packed = Packed::new(network.hidden(), network.weights(), Live::all(network.hidden()));
    for block in &samples.at.blocks()[..2048 / LANES] {
        activations.forward(pulp::Scalar::new(), &packed, &block.inputs);
        let [first, second] = &mut units;
        first.iter_mut().zip(&activations.first).for_each(|(unit, lanes)| unit.extend(lanes.0));
        second.iter_mut().zip(&activations.second).for_each(|(unit, lanes)| unit.extend(lanes.0));
    }
    units
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nbrdf::fit::random_network;
    use crate::sampling::{evaluate, rus32k};

    fn largest_difference(a: &Nbrdf, b: &Nbrdf) -> f32 {
        let at = &rus32k()[..500];
        let pairs = evaluate(a, at).into_iter().zip(evaluate(b, at));
        pairs.map(|(a, b)| a.zip(b, |a, b| (a - b).abs()).max()).fold(0.0, f32::max)
    }

    #[test]
    fn order_and_scale_of_hidden_units_do_not_change_the_function() {
        let network = random_network(4, 0);
        let backwards: Vec<usize> = (0..21).rev().collect();
        let rotated: Vec<usize> = (0..21).map(|i| (i + 5) % 21).collect();
        let permuted = permute(&network, [&backwards, &rotated]);
        assert_ne!(permuted, network);
        assert!(largest_difference(&network, &permuted) < 1e-5);
        let factors: Vec<f32> = (0..21).map(|i| 0.2 + 0.3 * i as f32).collect();
        assert!(largest_difference(&network, &rescale(&network, [&factors, &factors])) < 1e-4);
        assert!(largest_difference(&network, &balance(&network)) < 1e-4);
    }

    #[test]
    fn alignment_undoes_a_permutation_and_a_rescaling() {
        let network = random_network(5, 0);
        let order: Vec<usize> = (0..21).map(|i| (i * 8 + 3) % 21).collect();
        let factors: Vec<f32> = (0..21).map(|i| 0.5 + 0.1 * i as f32).collect();
        let disguised = rescale(&permute(&network, [&order, &order]), [&factors, &factors]);
        let (found, wanted) = (align(&disguised, &network), balance(&network));
        // Units that never fire cannot be told apart, so compare what mixing the two would give.
        let mixed = found.weights().iter().zip(wanted.weights()).map(|(a, b)| 0.5 * (a + b)).collect();
        assert!(largest_difference(&Nbrdf::published(mixed).unwrap(), &network) < 1e-3);
    }
}
