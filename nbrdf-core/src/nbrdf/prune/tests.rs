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
    let at: Vec<Directions> = rus32k().iter().copied().chain(random.take(20_000)).collect();
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
