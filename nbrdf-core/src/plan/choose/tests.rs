use proptest::prelude::*;

use super::*;

fn candidate(rung: usize, ns: f64, bytes: usize, shared: Option<(usize, usize)>) -> Candidate {
    Candidate { rung, ns, bytes, shared }
}

fn rungs_of(seats: &[Seat], by: By) -> Vec<usize> {
    choose(seats, by).iter().zip(seats).map(|(&i, seat)| seat.candidates[i].rung).collect()
}

#[test]
fn time_comes_first_and_bytes_decide_within_a_tenth_or_the_other_way_round() {
    let candidates = vec![
        candidate(0, 10.0, 3000, None),
        candidate(1, 10.8, 800, None),
        candidate(2, 20.0, 100, None),
        candidate(3, 12.0, 109, None),
    ];
    let seats = [Seat { material: 0, candidates }];
    assert_eq!(rungs_of(&seats, By::Time), [1]);
    assert_eq!(rungs_of(&seats, By::Bytes), [3]);
}

#[test]
fn a_decoder_is_worth_its_bytes_only_for_many() {
    let seat = |material| Seat {
        material,
        candidates: vec![candidate(0, 10.0, 2700, None), candidate(1, 10.0, 128, Some((0, 10_000)))],
    };
    for (count, expected) in [(3, 0), (5, 1)] {
        let seats: Vec<Seat> = (0..count).map(seat).collect();
        assert_eq!(rungs_of(&seats, By::Bytes), vec![expected; count], "{count}");
    }
}

#[test]
fn what_is_there_anyway_costs_nothing_more() {
    let near = Seat { material: 7, candidates: vec![candidate(3, 12.0, 800, None)] };
    let far = Seat { material: 7, candidates: vec![candidate(0, 1.0, 12, None), candidate(3, 12.0, 800, None)] };
    let other = Seat { material: 8, ..far.clone() };
    assert_eq!(rungs_of(&[near.clone(), far.clone(), other.clone()], By::Time), [3, 0, 0]);
    let far = Seat { candidates: vec![candidate(0, 1.0, 200, None), candidate(3, 12.0, 800, None)], ..far };
    assert_eq!(rungs_of(&[near, far, other], By::Bytes), [3, 3, 0], "200 more would be more than a tenth");
}

#[test]
fn objects_of_one_material_change_together() {
    let seat = |own: usize| Seat {
        material: 0,
        candidates: vec![candidate(own, 1.0, 100, None), candidate(9, 1.0, 150, None)],
    };
    assert_eq!(rungs_of(&[seat(1), seat(2)], By::Bytes), [9, 9], "150 together and not 200");
}

proptest! {
    #[test]
    fn no_single_change_saves_a_byte_and_haste_costs_a_tenth_at_most(
        kinds in prop::collection::vec(prop::collection::vec((0.5..2.0f64, 1..1000usize, 0..4usize), 5), 3),
        objects in prop::collection::vec((0..3usize, 1..32u32), 1..7),
    ) {
        let seat = |(material, mask): (usize, u32)| {
            let rungs = (0..5).filter(|rung| (mask >> rung) & 1 == 1);
            let one = |rung: usize| {
                let (ns, bytes, part) = kinds[material][rung];
                candidate(rung, ns, bytes, (part < 2).then_some((part, 500)))
            };
            Seat { material, candidates: rungs.map(one).collect() }
        };
        let seats: Vec<Seat> = objects.into_iter().map(seat).collect();
        let every: Vec<Vec<usize>> = seats.iter().map(|seat| (0..seat.candidates.len()).collect()).collect();
        let chosen = fewest(&seats, &every);
        let now = Tally::of(&seats, &chosen).bytes();
        for object in 0..seats.len() {
            for i in 0..seats[object].candidates.len() {
                let mut other = chosen.clone();
                other[object] = i;
                prop_assert!(Tally::of(&seats, &other).bytes() >= now);
            }
        }
        let faster = hasten(&seats, chosen.clone());
        let own: usize = seats.iter().zip(&faster).map(|(seat, &i)| seat.candidates[i].bytes.max(1000)).sum();
        prop_assert!(Tally::of(&seats, &faster).bytes() as f64 <= now as f64 + 0.1 * own as f64);
        let mut tally = Tally::of(&seats, &chosen);
        let all: Vec<usize> = (0..seats.len()).collect();
        let first = vec![0; seats.len()];
        tally.change(&seats, &all, &chosen, &first);
        prop_assert_eq!(tally.bytes(), Tally::of(&seats, &first).bytes());
    }
}
