//! Measured files that wait to be fitted, one after the other.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// A fit, as it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// Tells it from all others.
    pub number: u64,
    /// The material it will become.
    pub name: String,
    /// How much of it is done, 0..1.
    pub share: f32,
    /// How long it will take yet \[s\]; none while it waits, or nobody knows.
    pub left: Option<f64>,
}

/// What there is to do for a job.
#[derive(Clone, Debug)]
pub(super) struct Task {
    pub number: u64,
    pub path: PathBuf,
    pub name: String,
    /// What its network is kept under.
    pub key: Option<String>,
}

/// The queue; what is worked on stays at its front until it is finished.
#[derive(Default)]
pub(super) struct Fits {
    queue: Mutex<Queue>,
    bell: Condvar,
}

#[derive(Default)]
struct Queue {
    jobs: VecDeque<(Job, Task)>,
    next: u64,
    is_closed: bool,
}

impl Fits {
    /// One more, after all others; nothing where the same file waits already, or is being fitted as it is now.
    pub fn put(&self, path: PathBuf, name: String, key: Option<String>) {
        let mut queue = self.lock();
        let mut others = queue.jobs.iter_mut().enumerate().map(|(place, (_, task))| (place, task));
        if let Some((_, known)) = others.find(|(place, task)| task.path == path && (*place > 0 || task.key == key)) {
            // It is read when its turn comes.
            known.key = key;
            return;
        }
        let number = queue.next;
        queue.next += 1;
        let job = Job { number, name: name.clone(), share: 0.0, left: None };
        queue.jobs.push_back((job, Task { number, path, name, key }));
        self.bell.notify_all();
    }

    /// Waits for the next; none once the queue is closed.
    pub fn next(&self) -> Option<Task> {
        let is_waiting = |queue: &mut Queue| queue.jobs.is_empty() && !queue.is_closed;
        let queue = self.bell.wait_while(self.lock(), is_waiting).unwrap_or_else(PoisonError::into_inner);
        queue.jobs.front().filter(|_| !queue.is_closed).map(|(_, task)| task.clone())
    }

    /// Takes note of how far a job is; false if nobody wants it any more.
    pub fn progress(&self, number: u64, share: f32, left: Option<f64>) -> bool {
        let mut queue = self.lock();
        let is_closed = queue.is_closed;
        match queue.jobs.front_mut() {
            Some((job, _)) if job.number == number => {
                (job.share, job.left) = (share, left);
                !is_closed
            }
            _ => false,
        }
    }

    /// Takes a job out: it is done, or nobody wants it any more. Its file, if it was still there.
    pub fn remove(&self, number: u64) -> Option<PathBuf> {
        let mut queue = self.lock();
        let place = queue.jobs.iter().position(|(job, _)| job.number == number)?;
        queue.jobs.remove(place).map(|(_, task)| task.path)
    }

    /// All of them, in their order.
    pub fn shown(&self) -> Vec<Job> {
        self.lock().jobs.iter().map(|(job, _)| job.clone()).collect()
    }

    /// Ends everything.
    pub fn close(&self) {
        self.lock().is_closed = true;
        self.bell.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jobs_are_done_in_their_order_and_a_cancelled_one_is_told_so() {
        let fits = Fits::default();
        for name in ["a", "b", "c"] {
            fits.put(PathBuf::from(name), name.to_owned(), None);
        }
        let first = fits.next().unwrap();
        assert_eq!(first.name, "a");
        assert!(fits.progress(first.number, 0.5, Some(1.0)));
        assert_eq!(fits.shown()[0].share, 0.5);
        assert_eq!(fits.remove(first.number), Some(PathBuf::from("a")));
        assert!(!fits.progress(first.number, 0.6, None) && fits.remove(first.number).is_none());
        assert_eq!(fits.remove(1), Some(PathBuf::from("b")), "one that waits can be cancelled, too");
        assert_eq!(fits.next().unwrap().name, "c");
        fits.close();
        assert!(fits.next().is_none());
    }

    #[test]
    fn the_same_file_is_fitted_once_unless_it_has_changed_since_its_fit_began() {
        let fits = Fits::default();
        let put = |path: &str, key: &str| {
            fits.put(PathBuf::from(path), path.to_owned(), Some(key.to_owned()));
            fits.shown().len()
        };
        assert_eq!([put("a", "1"), put("b", "1"), put("a", "1"), put("b", "2"), put("a", "2")], [1, 2, 2, 2, 3]);
        assert_eq!(put("a", "3"), 3);
        let keys =
            std::iter::from_fn(|| fits.next().inspect(|task| drop(fits.remove(task.number))).map(|task| task.key));
        assert_eq!(keys.take(3).map(Option::unwrap).collect::<Vec<_>>(), ["1", "2", "3"]);
    }
}
