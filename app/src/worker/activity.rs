//! Which threads are at work, and whether the window is closed.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Between two looks.
const STEP: Duration = Duration::from_millis(10);

/// Counts who is at work.
#[derive(Clone, Default)]
pub(super) struct Activity {
    busy: Arc<AtomicUsize>,
    is_over: Arc<AtomicBool>,
}

/// Somebody is at work as long as this is there.
pub(super) struct Busy(Arc<AtomicUsize>);

impl Activity {
    /// Begins some work.
    pub fn begin(&self) -> Busy {
        self.busy.fetch_add(1, Ordering::Relaxed);
        Busy(Arc::clone(&self.busy))
    }

    /// Waits so long at most until nobody is at work; whether nobody is. `stops` ends the waiting.
    pub fn rests(&self, patience: Duration, stops: impl Fn() -> bool) -> bool {
        let start = Instant::now();
        while self.busy.load(Ordering::Relaxed) > 0 && !stops() && start.elapsed() < patience {
            std::thread::sleep(STEP);
        }
        self.busy.load(Ordering::Relaxed) == 0
    }

    /// The window is closed: all work is in vain.
    pub fn end(&self) {
        self.is_over.store(true, Ordering::Relaxed);
    }

    /// Whether the window is closed; asked between pieces of work that wait in no mailbox.
    pub fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_rest_once_nobody_is_at_work() {
        let activity = Activity::default();
        let never = || false;
        assert!(activity.rests(Duration::ZERO, never));
        let busy = activity.begin();
        assert!(!activity.rests(Duration::ZERO, never) && !activity.rests(Duration::MAX, || true));
        let handle = std::thread::spawn(move || drop(busy));
        assert!(activity.rests(Duration::MAX, never));
        handle.join().unwrap();
    }
}
