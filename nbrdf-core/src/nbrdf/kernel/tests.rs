use std::f32::consts::{FRAC_PI_2, PI};

use super::*;
use crate::nbrdf::fit::{generator, random_network};
use crate::nbrdf::{MAX_HIDDEN, Nbrdf, weight_count};
use crate::sampling::rus32k;
use crate::{Brdf, Vec3};
use rand::RngExt;

fn evaluated(set: InstructionSet, network: &Nbrdf, at: &[Directions]) -> Vec<Rgb> {
    let mut out = vec![Rgb::BLACK; at.len()];
    forward(set, &network.packed, Sign::Kept, (at, Azimuth::Dropped), &mut out);
    out
}

/// A network of any widths with weights around 1.
fn network_of(hidden: [usize; 2], seed: u64) -> Nbrdf {
    let mut rng = generator(seed, 0);
    let scale = 2.0 / (hidden[0].max(hidden[1]) as f32).sqrt();
    let weights = (0..weight_count(hidden)).map(|_| scale * rng.random_range(-1.0..1.0f32)).collect();
    Nbrdf::new(hidden, weights).unwrap()
}

fn bits(values: &[Rgb]) -> Vec<[u32; 3]> {
    values.iter().map(|value| value.0.map(f32::to_bits)).collect()
}

#[test]
fn every_instruction_set_agrees_with_the_plain_loop_in_f64() {
    let at: Vec<Directions> = rus32k().iter().step_by(31).copied().collect();
    for hidden in [[21, 21], [1, 1], [6, 12], [7, 5], [32, 32], [16, 40], [MAX_HIDDEN, 3]] {
        let network = network_of(hidden, 1);
        for set in InstructionSet::available() {
            for (at, value) in at.iter().zip(evaluated(set, &network, &at)) {
                for (own, plain) in value.0.into_iter().zip(forward_plainly(&network, at.half_diff())) {
                    let allowed = 1e-5 * (1.0 + plain.abs());
                    assert!((f64::from(own) - plain).abs() <= allowed, "{} {hidden:?}: {own} {plain}", set.name());
                }
            }
        }
    }
}

#[test]
fn all_vector_instruction_sets_give_the_same_bits() {
    let network = random_network(2, 0);
    let sets = InstructionSet::available();
    let all: Vec<_> = sets[1..].iter().map(|set| bits(&evaluated(*set, &network, rus32k()))).collect();
    assert!(
        all.windows(2).all(|pair| pair[0] == pair[1]),
        "{:?}",
        sets.iter().map(|set| set.name()).collect::<Vec<_>>()
    );
}

#[test]
fn any_number_of_directions_gives_the_bits_of_each_alone() {
    let network = random_network(3, 0);
    for count in [0, 1, 15, 16, 31, 32, 33, 64, 100] {
        let at = &rus32k()[..count];
        let together = evaluated(InstructionSet::fastest(), &network, at);
        let alone: Vec<Rgb> = at.iter().map(|&at| evaluated(InstructionSet::fastest(), &network, &[at])[0]).collect();
        assert_eq!(bits(&together), bits(&alone));
        let mut prepared = vec![Rgb::BLACK; count];
        forward_blocks(
            InstructionSet::fastest(),
            &network.packed,
            Sign::Kept,
            &blocks(at, Azimuth::Dropped),
            &mut prepared,
        );
        assert_eq!(bits(&together), bits(&prepared));
    }
}

#[test]
fn directions_below_the_horizon_and_nan_give_black() {
    let network = random_network(0, 0);
    let below = Directions::new(Vec3::new(0.6, 0.0, -0.8), Vec3::Z);
    let nan = Directions::new(Vec3::new(f32::NAN, 0.0, f32::NAN), Vec3::Z);
    assert_eq!(network.eval(below), Rgb::BLACK);
    assert_eq!(network.eval(nan), Rgb::BLACK);
    let mut out = [Rgb::splat(7.0); 3];
    network.eval_into(&[below, rus32k()[0], nan], &mut out);
    assert_eq!((out[0], out[2]), (Rgb::BLACK, Rgb::BLACK));
    assert_eq!(out[1], network.eval(rus32k()[0]));
}

#[test]
fn half_and_difference_vectors_are_those_of_the_slow_function() {
    let tiny = |x: f32, y: f32| Vec3::new(x, y, 1.0);
    let mut at: Vec<Directions> = rus32k().iter().step_by(7).copied().collect();
    // Near the normal, at it, and for vectors that are almost opposite.
    for (l, v) in [(1e-3, -1e-3), (1e-6, 1e-7), (1e-12, -2e-12), (1e-20, 1e-20), (1e-40, 0.0), (0.0, 0.0)] {
        at.push(Directions::new(tiny(l, 0.5 * l), tiny(v, l)));
    }
    at.push(Directions::new(Vec3::new(0.8, 0.0, 0.6), Vec3::new(-0.8, 0.0, 0.6)));
    at.push(Directions::from_angles(1.57, 0.3, 1.57, 3.4));
    for (e, turn) in [(1e-2, 0.0), (2e-3, 1e-3), (1e-3, 1e-4), (1e-4, 0.0), (1e-7, 0.0)] {
        at.push(Directions::from_angles(FRAC_PI_2 - e, 0.3, FRAC_PI_2 - 0.5 * e, 0.3 + PI + turn));
    }
    for set in InstructionSet::available() {
        for azimuth in [Azimuth::Dropped, Azimuth::Kept] {
            for (chunk, block) in at.chunks(LANES).zip(blocks_with(set, &at, azimuth)) {
                for (lane, pair) in chunk.iter().enumerate() {
                    let own = block.inputs.map(|lanes| lanes.0[lane]);
                    let slow = match azimuth {
                        Azimuth::Dropped => pair.half_diff(),
                        Azimuth::Kept => pair.turning_half_diff(),
                    };
                    let slow = [slow.half.to_array(), slow.diff.to_array()].concat();
                    for (own, &input) in own.iter().zip(&ORDER) {
                        let (name, slow) = (set.name(), slow[input]);
                        assert!((own - slow).abs() < 3e-7, "{name}, {azimuth:?} {input}: {own} {slow} at {pair:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_sine_of_the_half_angle_keeps_its_digits_near_the_normal() {
    for angle in [1e-2f32, 1e-4, 1e-6] {
        let at = [Directions::from_angles(0.5 + angle, 0.0, 0.5 - angle, std::f32::consts::PI)];
        for set in InstructionSet::available() {
            let (own, slow) = (blocks_with(set, &at, Azimuth::Dropped)[0].inputs[0].0[0], at[0].half_diff().half.x);
            assert!((own / slow - 1.0).abs() < 5e-7, "{}: {own} {slow}", set.name());
        }
    }
}

#[test]
fn networks_with_enormous_weights_stay_finite() {
    for size in [1e10f32, 1e20, 1.5e38] {
        let mut rng = generator(8, 0);
        let weights = (0..weight_count([21, 21])).map(|_| rng.random_range(-size..size)).collect();
        let network = Nbrdf::published(weights).unwrap();
        let mut out = vec![Rgb::BLACK; 1000];
        network.eval_into(&rus32k()[..1000], &mut out);
        assert!(out.iter().all(|f| f.is_finite() && f.min() >= 0.0));
    }
}
