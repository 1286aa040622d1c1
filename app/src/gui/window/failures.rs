//! What the window could not write, for whoever has opened it.

use std::sync::{Arc, Mutex, PoisonError};

/// What could not be written, which file and why; clones share it.
#[derive(Clone, Debug, Default)]
pub struct Failures(Arc<Mutex<Vec<String>>>);

impl Failures {
    /// Another one.
    pub fn add(&self, why: String) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(why);
    }

    /// The first of them, if there are any.
    pub fn first(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).first().cloned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_opened_the_window_hears_of_the_first_failure() {
        let failures = Failures::default();
        assert_eq!(failures.first(), None);
        let of_camera = failures.clone();
        of_camera.add("a.png: no space".to_owned());
        of_camera.add("b.png: no space".to_owned());
        assert_eq!(failures.first().as_deref(), Some("a.png: no space"));
    }
}
