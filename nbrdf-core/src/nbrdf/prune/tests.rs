use std::f32::consts::{FRAC_PI_2, PI};

use rand::RngExt;

use super::*;
use crate::library::builtin;
use crate::nbrdf::INPUTS;
use crate::nbrdf::fit::{generator, random_network};
use crate::nbrdf::samples::random_directions;
use crate::{Brdf, Directions, Rgb};

fn bits(network: &Nbrdf, at: &[Directions]) -> Vec<[u32; 3]> {
    let mut out = vec![Rgb::BLACK; at.len()];
    network.eval_signed_into(at, &mut out);
    out.iter().map(|f| f.0.map(f32::to_bits)).collect()
}

#[test]
fn pruning_changes_no_bit_of_any_built_in_material() {
    let mut rng = generator(12, 0);
    let random = std::iter::repeat_with(|| random_directions(&mut rng)).filter(|at| at.is_above());
    let at: Vec<Directions> = rus32k().iter().copied().chain(random.take(20_000)).chain(almost_opposite()).collect();
    let (mut live, mut whole) = (0, 0);
    for entry in builtin::independent() {
        let pruned = entry.network.pruned();
        assert_eq!(bits(&pruned, &at), bits(&entry.network, &at), "{}", entry.name);
        assert_eq!(pruned, entry.network, "the weights stay whole");
        live += entry.network.live().multiply_adds();
        whole += Live::all(entry.network.hidden()).multiply_adds();
    }
    println!("{:.0} of {:.0} multiply-adds left on average", live as f64 / 134.0, whole as f64 / 134.0);
    assert!(live < whole * 9 / 10);
}

/// Pairs near the horizon on opposite sides, where rounding and lengths decide over the half vector.
fn almost_opposite() -> impl Iterator<Item = Directions> {
    let mut rng = generator(13, 0);
    std::iter::repeat_with(move || {
        let [above, turn]: [f32; 2] = std::array::from_fn(|_| 10f32.powf(rng.random_range(-9.0..-1.0)));
        let phi = rng.random_range(-PI..PI);
        let at = Directions::from_angles(FRAC_PI_2 - above, phi, FRAC_PI_2 - turn, phi + PI + above * turn.sqrt());
        let mut length = || 1.0 + rng.random_range(-1e-6..1e-6f32);
        Directions::new(at.light * length(), at.view * length())
    })
    .filter(|at| at.is_above())
    .take(20_000)
}

#[test]
fn units_at_the_edge_of_firing_change_nothing_where_light_and_view_are_almost_opposite() {
    let [(k1, b1), (k2, b2), (k3, _)] = Layout::new([21, 21]).layers;
    let at: Vec<Directions> = almost_opposite().collect();
    // Inputs are h.x h.y h.z d.x d.y d.z; each unit stays just below 0 for exact unit vectors.
    for (parts, bias) in
        [(&[(5, -1.0)][..], -3e-3), (&[(2, -1.0)], -3e-3), (&[(0, 1.0)], -1.001), (&[(3, 0.6), (5, 0.8)], -1.001)]
    {
        let mut weights = vec![0.0; 675];
        for &(input, weight) in parts {
            weights[k1.start + 21 * input] = weight;
        }
        (weights[b1.start], weights[k2.start], weights[b2.start], weights[k3.start]) = (bias, 1.0, 0.1, 1.0);
        let network = Nbrdf::published(weights).unwrap();
        assert!(network.live().units[0].is_empty(), "{parts:?}");
        assert_eq!(bits(&network.pruned(), &at), bits(&network, &at), "{parts:?}");
    }
}

#[test]
fn a_unit_that_touches_zero_is_decided_soon() {
    // relu(h.z − 1) is 0 at the normal and below it elsewhere: no region around the normal decides it.
    let mut weights = vec![0.0; 675];
    let [(k1, b1), ..] = Layout::new([21, 21]).layers;
    (weights[k1.start + 21 * 2], weights[b1.start]) = (1.0, -1.0);
    let network = Nbrdf::published(weights).unwrap();
    let live = network.live();
    assert_eq!(live.units[0], [0]);
}

#[test]
fn nothing_is_left_out_of_networks_whose_sums_may_overflow() {
    let mut weights = vec![0.0; 675];
    let [(k1, b1), ..] = Layout::new([21, 21]).layers;
    weights[k1.start..k1.start + 6 * 21].fill(-3e38);
    weights[b1.start..b1.end].fill(-3e38);
    assert_eq!(Nbrdf::published(weights).unwrap().live().units[0].len(), 21);
}

#[test]
fn a_unit_that_can_fire_is_never_left_out() {
    // Unit 0 fires only where θ_half is within a degree of the normal: no sampled direction need show it.
    let mut weights = random_network(3, 0).into_weights();
    let [(k1, b1), ..] = Layout::new([21, 21]).layers;
    for input in 0..INPUTS {
        weights[k1.start + 21 * input] = if input == 2 { 1.0 } else { 0.0 };
    }
    weights[b1.start] = -(1f32.to_radians().cos());
    let fires = Nbrdf::published(weights.clone()).unwrap();
    assert!(fires.live().units[0].contains(&0));
    weights[b1.start] = -1.00001;
    let silent = Nbrdf::published(weights).unwrap();
    assert!(!silent.live().units[0].contains(&0));
}

#[test]
fn units_that_fire_only_below_the_horizon_are_left_out() {
    // h.x + |d.x| large at once is below the horizon: at θ_half = 60°, |d.x| = 1 is.
    let mut weights = vec![0.0; 675];
    let [(k1, b1), (k2, b2), (k3, _)] = Layout::new([21, 21]).layers;
    (weights[k1.start], weights[k1.start + 21 * 3], weights[b1.start]) = (1.0, 1.0, -1.5);
    (weights[k2.start], weights[b2.start], weights[k3.start]) = (1.0, 0.1, 1.0);
    let network = Nbrdf::published(weights).unwrap();
    let live = network.live();
    assert!(live.units[0].is_empty(), "{live:?}");
    assert_eq!(live.units[1], [0]);
}

#[test]
fn what_could_not_fire_before_may_fire_after_a_change_of_weights() {
    let (mut network, other) = (random_network(1, 0).pruned(), random_network(2, 0));
    network.set_weights(other.weights()).unwrap();
    assert_eq!(bits(&network, rus32k()), bits(&other, rus32k()));
}
