//! One model per object out of those that are good enough, cheapest together.

mod tally;

use std::collections::BTreeSet;

use super::{By, TIE};
pub(super) use tally::Tally;

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

/// An object and what it can choose from.
#[derive(Clone, Debug)]
pub(super) struct Seat {
    /// Objects of one material share its models.
    pub material: usize,
    /// At least one.
    pub candidates: Vec<Candidate>,
}

/// Which candidate each object takes. By time: of those within a tie of an object's fastest the fewest bytes of all
/// together. By bytes: the fewest of all together, and of those within a tie of an object's share the fastest.
pub(super) fn choose(seats: &[Seat], by: By) -> Vec<usize> {
    let allowed: Vec<Vec<usize>> = seats.iter().map(|seat| allowed(&seat.candidates, by)).collect();
    let fewest = fewest(seats, &allowed);
    match by {
        By::Time => fewest,
        By::Bytes => hasten(seats, fewest),
    }
}

/// The fewest bytes of all together that changes of one object, or of all of one material, lead to.
fn fewest(seats: &[Seat], allowed: &[Vec<usize>]) -> Vec<usize> {
    let shared: BTreeSet<usize> =
        seats.iter().flat_map(|seat| &seat.candidates).filter_map(|own| own.shared).map(|(number, _)| number).collect();
    // What is shared pays for several objects or for none: each is tried for all objects that can use it.
    let mut starts = vec![alone(seats, allowed, None)];
    starts.extend(shared.into_iter().map(|number| alone(seats, allowed, Some(number))));
    let ends = starts.into_iter().map(|start| descend(seats, allowed, start));
    ends.min_by_key(|chosen| Tally::of(seats, chosen).bytes()).unwrap_or_default()
}

/// By time: what is within a tie of the fastest.
fn allowed(candidates: &[Candidate], by: By) -> Vec<usize> {
    let least = candidates.iter().map(|own| own.ns).fold(f64::INFINITY, f64::min);
    let is_allowed = |own: &Candidate| by == By::Bytes || own.ns <= TIE * least;
    (0..candidates.len()).filter(|&i| is_allowed(&candidates[i])).collect()
}

/// Each object by itself, with one shared part for nothing.
fn alone(seats: &[Seat], allowed: &[Vec<usize>], free: Option<usize>) -> Vec<usize> {
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

/// Objects change their choice, one by one and all of a material together, as long as that saves bytes.
fn descend(seats: &[Seat], allowed: &[Vec<usize>], mut chosen: Vec<usize>) -> Vec<usize> {
    let mut tally = Tally::of(seats, &chosen);
    let materials: BTreeSet<usize> = seats.iter().map(|seat| seat.material).collect();
    let groups: Vec<Vec<usize>> = materials
        .into_iter()
        .map(|material| (0..seats.len()).filter(|&object| seats[object].material == material).collect())
        .chain((0..seats.len()).map(|object| vec![object]))
        .collect();
    loop {
        let before = tally.bytes();
        for group in &groups {
            for rung in rungs(seats, allowed, group) {
                let other: Vec<usize> =
                    group.iter().filter_map(|&object| place(&seats[object], &allowed[object], rung)).collect();
                let (now, old): (_, Vec<usize>) = (tally.bytes(), group.iter().map(|&object| chosen[object]).collect());
                tally.change(seats, group, &old, &other);
                if tally.bytes() < now {
                    group.iter().zip(&other).for_each(|(&object, &i)| chosen[object] = i);
                } else {
                    tally.change(seats, group, &other, &old);
                }
            }
        }
        if tally.bytes() >= before {
            return chosen;
        }
    }
}

/// Rungs that all of these objects may take.
fn rungs(seats: &[Seat], allowed: &[Vec<usize>], group: &[usize]) -> Vec<usize> {
    let first = group.first().map_or(&[][..], |&object| &allowed[object]);
    let rungs = first.iter().map(|&i| seats[group[0]].candidates[i].rung);
    rungs.filter(|&rung| group.iter().all(|&o| place(&seats[o], &allowed[o], rung).is_some())).collect()
}

fn place(seat: &Seat, allowed: &[usize], rung: usize) -> Option<usize> {
    allowed.iter().copied().find(|&i| seat.candidates[i].rung == rung)
}

/// Objects take what is faster where that costs hardly more bytes.
fn hasten(seats: &[Seat], mut chosen: Vec<usize>) -> Vec<usize> {
    let mut tally = Tally::of(seats, &chosen);
    for (object, seat) in seats.iter().enumerate() {
        let before = tally.bytes();
        let most = before as f64 + (TIE - 1.0) * seat.candidates[chosen[object]].bytes as f64;
        let mut order: Vec<usize> = (0..seat.candidates.len()).collect();
        order.sort_by(|&a, &b| seat.candidates[a].ns.total_cmp(&seat.candidates[b].ns));
        for i in order.into_iter().take_while(|&i| seat.candidates[i].ns < seat.candidates[chosen[object]].ns) {
            tally.change(seats, &[object], &[chosen[object]], &[i]);
            if tally.bytes() as f64 <= most {
                chosen[object] = i;
                break;
            }
            tally.change(seats, &[object], &[i], &[chosen[object]]);
        }
    }
    chosen
}

#[cfg(test)]
mod tests;
