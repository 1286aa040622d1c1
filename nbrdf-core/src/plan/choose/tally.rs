//! Bytes of all models together, what several use counted once.

use std::collections::BTreeMap;

use super::{Candidate, Seat};

/// How often every part is used.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Models, by material and rung.
    models: BTreeMap<(usize, usize), usize>,
    /// What models share, by number.
    shared: BTreeMap<usize, usize>,
    bytes: usize,
}

impl Tally {
    /// Of every object's choice.
    pub fn of(seats: &[Seat], chosen: &[usize]) -> Self {
        let mut tally = Self::default();
        for (seat, &i) in seats.iter().zip(chosen) {
            tally.add(seat.material, &seat.candidates[i]);
        }
        tally
    }

    /// All together.
    pub const fn bytes(&self) -> usize {
        self.bytes
    }

    /// One more object takes a model.
    pub fn add(&mut self, material: usize, own: &Candidate) {
        let used = self.models.entry((material, own.rung)).or_default();
        self.bytes += if *used == 0 { own.bytes } else { 0 };
        *used += 1;
        if let Some((number, bytes)) = own.shared {
            let used = self.shared.entry(number).or_default();
            self.bytes += if *used == 0 { bytes } else { 0 };
            *used += 1;
        }
    }

    fn remove(&mut self, material: usize, own: &Candidate) {
        if let Some(used) = self.models.get_mut(&(material, own.rung)) {
            *used -= 1;
            self.bytes -= if *used == 0 { own.bytes } else { 0 };
        }
        if let Some((number, bytes)) = own.shared
            && let Some(used) = self.shared.get_mut(&number)
        {
            *used -= 1;
            self.bytes -= if *used == 0 { bytes } else { 0 };
        }
    }

    /// Some objects take other candidates than before.
    pub fn change(&mut self, seats: &[Seat], objects: &[usize], before: &[usize], after: &[usize]) {
        for (&object, &i) in objects.iter().zip(before) {
            self.remove(seats[object].material, &seats[object].candidates[i]);
        }
        for (&object, &i) in objects.iter().zip(after) {
            self.add(seats[object].material, &seats[object].candidates[i]);
        }
    }
}
