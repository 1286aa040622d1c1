//! Buffers of pictures, used again: a frame of scrubbing needs as many as are on their way to the window.

use std::sync::{Arc, Mutex, PoisonError};

/// Buffers kept at most; a window shows fewer spheres.
const KEPT: usize = 32;

/// Empty buffers, shared by those who fill and those who show.
#[derive(Clone, Default)]
pub struct Plates(Arc<Mutex<Vec<Vec<u8>>>>);

impl Plates {
    /// A buffer, used before or new.
    pub fn take(&self) -> Vec<u8> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default()
    }

    /// Takes a buffer back that has been shown.
    pub fn give_back(&self, plate: Vec<u8>) {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() < KEPT {
            kept.push(plate);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_that_comes_back_is_used_again() {
        let plates = Plates::default();
        let mut plate = plates.take();
        plate.resize(1000, 7);
        let place = plate.as_ptr();
        plates.clone().give_back(plate);
        let again = plates.take();
        assert_eq!(again.as_ptr(), place);
        assert!(plates.take().is_empty());
    }
}
