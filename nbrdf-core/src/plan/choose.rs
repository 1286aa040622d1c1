//! One model per object out of those that are good enough, cheapest together.

use std::collections::BTreeSet;

use super::{By, TIE};

/// A model that is good enough for an object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    /// Place of its kind on the ladder.
    pub rung: usize,
    /// Nanoseconds per evaluation.
    pub ns: f64,
    /// Bytes of the material.
    pub bytes: usize,
    /// What it needs beside, by number, and bytes of that.
    pub shared: Option<(usize, usize)>,
}

/// An object's choice, and what of it is stored once for all objects that use it.
#[derive(Clone, Debug)]
pub(super) struct Seat {
    /// Objects of one material share its models.
    pub material: usize,
    /// At least one.
    pub candidates: Vec<Candidate>,
}

/// Which candidate each object takes.
pub(super) fn choose(seats: &[Seat], by: By) -> Vec<usize> {
    let allowed: Vec<Vec<usize>> = seats.iter().map(|seat| allowed(&seat.candidates, by)).collect();
    let shared: BTreeSet<usize> =
        seats.iter().flat_map(|seat| &seat.candidates).filter_map(|own| own.shared).map(|(number, _)| number).collect();
    // What is shared pays for several objects or for none: each is tried for all objects that can use it.
    let mut starts = vec![cheapest(seats, &allowed, None)];
    starts.extend(shared.into_iter().map(|number| cheapest(seats, &allowed, Some(number))));
    let ends = starts.into_iter().map(|start| descend(seats, &allowed, start));
    ends.min_by(|a, b| cost(seats, a).total_cmp(&cost(seats, b))).unwrap_or_default()
}

/// By time: what is within a tie of the fastest.
fn allowed(candidates: &[Candidate], by: By) -> Vec<usize> {
    let least = candidates.iter().map(|own| own.ns).fold(f64::INFINITY, f64::min);
    let is_allowed = |own: &Candidate| by == By::Bytes || own.ns <= TIE * least;
    (0..candidates.len()).filter(|&i| is_allowed(&candidates[i])).collect()
}

/// Each object by itself, with one shared part for nothing.
fn cheapest(seats: &[Seat], allowed: &[Vec<usize>], free: Option<usize>) -> Vec<usize> {
    let one = |(seat, allowed): (&Seat, &Vec<usize>)| {
        let bytes = |i: &usize| {
            let own = &seat.candidates[*i];
            own.bytes + own.shared.filter(|(number, _)| Some(*number) != free).map_or(0, |(_, bytes)| bytes)
        };
        let best = allowed
            .iter()
            .copied()
            .min_by(|a, b| bytes(a).cmp(&bytes(b)).then(seat.candidates[*a].ns.total_cmp(&seat.candidates[*b].ns)));
        best.unwrap_or_default()
    };
    seats.iter().zip(allowed).map(one).collect()
}

/// Objects change their choice one by one, as long as that saves something.
fn descend(seats: &[Seat], allowed: &[Vec<usize>], mut chosen: Vec<usize>) -> Vec<usize> {
    loop {
        let before = cost(seats, &chosen);
        for object in 0..seats.len() {
            let cost_of = |i: usize| {
                let mut other = chosen.clone();
                other[object] = i;
                cost(seats, &other)
            };
            let best = allowed[object].iter().copied().min_by(|a, b| cost_of(*a).total_cmp(&cost_of(*b)));
            if let Some(best) = best.filter(|&best| cost_of(best) < cost(seats, &chosen)) {
                chosen[object] = best;
            }
        }
        if cost(seats, &chosen) >= before {
            return chosen;
        }
    }
}

/// Bytes of all together, what is used twice counted once; of the same bytes less time is better.
fn cost(seats: &[Seat], chosen: &[usize]) -> f64 {
    let own = || seats.iter().zip(chosen).map(|(seat, &i)| (seat.material, &seat.candidates[i]));
    let ns: f64 = own().map(|(_, own)| own.ns).sum();
    total_bytes(own()) as f64 + 1e-6 * ns
}

/// Bytes of models, each with its material: the same model of the same material counts once, and so do shared parts.
pub(super) fn total_bytes<'a>(models: impl Iterator<Item = (usize, &'a Candidate)>) -> usize {
    let (mut kept, mut shared) = (BTreeSet::new(), BTreeSet::new());
    let mut total = 0;
    for (material, own) in models {
        total += if kept.insert((material, own.rung)) { own.bytes } else { 0 };
        total += own.shared.filter(|(number, _)| shared.insert(*number)).map_or(0, |(_, bytes)| bytes);
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(rung: usize, ns: f64, bytes: usize, shared: Option<(usize, usize)>) -> Candidate {
        Candidate { rung, ns, bytes, shared }
    }

    fn rungs(seats: &[Seat], by: By) -> Vec<usize> {
        choose(seats, by).iter().zip(seats).map(|(&i, seat)| seat.candidates[i].rung).collect()
    }

    #[test]
    fn time_comes_first_and_bytes_decide_within_a_tenth() {
        let candidates =
            vec![candidate(0, 10.0, 3000, None), candidate(1, 10.8, 800, None), candidate(2, 20.0, 10, None)];
        let seats = [Seat { material: 0, candidates }];
        assert_eq!(rungs(&seats, By::Time), [1]);
        assert_eq!(rungs(&seats, By::Bytes), [2]);
    }

    #[test]
    fn a_decoder_is_worth_its_bytes_only_for_many() {
        let seat = |material| Seat {
            material,
            candidates: vec![candidate(0, 10.0, 2700, None), candidate(1, 10.0, 128, Some((0, 10_000)))],
        };
        for (count, expected) in [(3, 0), (5, 1)] {
            let seats: Vec<Seat> = (0..count).map(seat).collect();
            assert_eq!(rungs(&seats, By::Bytes), vec![expected; count], "{count}");
        }
    }

    #[test]
    fn what_is_there_anyway_costs_nothing_more() {
        let near = Seat { material: 7, candidates: vec![candidate(3, 12.0, 800, None)] };
        let far = Seat { material: 7, candidates: vec![candidate(0, 1.0, 12, None), candidate(3, 12.0, 800, None)] };
        let other = Seat { material: 8, ..far.clone() };
        assert_eq!(rungs(&[near.clone(), far.clone(), other.clone()], By::Bytes), [3, 3, 0]);
        assert_eq!(rungs(&[near, far, other], By::Time), [3, 0, 0]);
    }
}
