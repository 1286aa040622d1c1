//! A mailbox that keeps only the newest letter.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The newest value put in; taking it leaves a copy, which can be asked for again.
pub struct Mailbox<T> {
    slot: Mutex<Slot<T>>,
    bell: Condvar,
}

struct Slot<T> {
    newest: Option<T>,
    is_unread: bool,
    is_closed: bool,
    is_finished: bool,
}

impl<T> Default for Mailbox<T> {
    fn default() -> Self {
        Self {
            slot: Mutex::new(Slot { newest: None, is_unread: false, is_closed: false, is_finished: false }),
            bell: Condvar::new(),
        }
    }
}

impl<T: Clone> Mailbox<T> {
    /// Replaces whatever was there.
    pub fn put(&self, value: T) {
        let mut slot = self.lock();
        slot.newest = Some(value);
        slot.is_unread = true;
        self.bell.notify_all();
    }

    /// Makes the newest value unread again: what it depends on has changed.
    pub fn again(&self) {
        let mut slot = self.lock();
        slot.is_unread = slot.newest.is_some();
        self.bell.notify_all();
    }

    /// The newest value, read or not; it stays as unread as it is.
    pub fn newest(&self) -> Option<T> {
        self.lock().newest.clone()
    }

    /// Waits for an unread value; none once the mailbox is closed, or finished and everything is read.
    pub fn take(&self) -> Option<T> {
        let is_waiting = |slot: &mut Slot<T>| !slot.is_unread && !slot.is_closed && !slot.is_finished;
        let mut slot = self.bell.wait_while(self.lock(), is_waiting).unwrap_or_else(PoisonError::into_inner);
        let is_read = slot.is_closed || !slot.is_unread;
        slot.is_unread = false;
        if is_read { None } else { slot.newest.clone() }
    }

    /// Whether something newer than the last value taken is there.
    pub fn has_news(&self) -> bool {
        let slot = self.lock();
        slot.is_unread || slot.is_closed
    }

    /// Waits; whether nothing newer came in the meantime.
    pub fn stays_quiet(&self, patience: Duration) -> bool {
        let waited = self.bell.wait_timeout_while(self.lock(), patience, |slot| !slot.is_unread && !slot.is_closed);
        waited.unwrap_or_else(PoisonError::into_inner).1.timed_out()
    }

    /// Nothing will be put in any more: its reader may go once it has read the last letter.
    pub fn finish(&self) {
        self.lock().is_finished = true;
        self.bell.notify_all();
    }

    /// Ends all waiting.
    pub fn close(&self) {
        self.lock().is_closed = true;
        self.bell.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Slot<T>> {
        self.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_letter_wins_and_is_read_once() {
        let mailbox = Mailbox::default();
        mailbox.put(1);
        mailbox.put(2);
        assert_eq!(mailbox.take(), Some(2));
        assert!(!mailbox.has_news());
        assert!(mailbox.stays_quiet(Duration::from_millis(1)));
        mailbox.again();
        assert_eq!(mailbox.take(), Some(2));
    }

    #[test]
    fn a_closed_mailbox_lets_its_reader_go() {
        let mailbox = Mailbox::<u8>::default();
        mailbox.close();
        assert_eq!(mailbox.take(), None);
    }

    #[test]
    fn the_last_letter_of_a_finished_mailbox_is_read() {
        let mailbox = Mailbox::default();
        mailbox.put(1);
        mailbox.finish();
        assert_eq!([mailbox.take(), mailbox.take()], [Some(1), None]);
    }
}
