//! What is learned when it is first asked for.

use std::any::Any;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use anyhow::Result;

type Part = (&'static str, Arc<dyn Any + Send + Sync>);

/// Learned parts, each learned once.
pub(super) struct Once(Mutex<Vec<Part>>);

impl Once {
    pub(super) const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The part of this name, of which every name has one type.
    pub(super) fn get<T: Send + Sync + 'static>(
        &self,
        name: &'static str,
        learn: impl FnOnce() -> Result<T>,
    ) -> Result<Arc<T>> {
        if let Some(known) = known(&self.all(), name) {
            return Ok(known);
        }
        // Not under the lock: learning is parallel, and a thread that waits in it may be handed a task that asks here.
        let learned = Arc::new(learn()?);
        let mut all = self.all();
        Ok(known(&all, name).unwrap_or_else(|| {
            all.push((name, Arc::clone(&learned) as _));
            learned
        }))
    }

    fn all(&self) -> MutexGuard<'_, Vec<Part>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn known<T: Send + Sync + 'static>(all: &[Part], name: &str) -> Option<Arc<T>> {
    let (_, found) = all.iter().find(|(known, _)| *known == name)?;
    let found = Arc::clone(found).downcast();
    debug_assert!(found.is_ok(), "'{name}' is of one type");
    found.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_who_ask_get_the_part_that_was_learned_first() {
        let once = Once::new();
        let parts: Vec<Arc<usize>> = std::thread::scope(|scope| {
            let once = &once;
            let ask = |i: usize| scope.spawn(move || once.get("part", || Ok(i)).unwrap());
            let asked: Vec<_> = (0..8).map(ask).collect();
            asked.into_iter().map(|asked| asked.join().unwrap()).collect()
        });
        assert!(parts.windows(2).all(|pair| Arc::ptr_eq(&pair[0], &pair[1])));
        assert_eq!(once.all().len(), 1);
        let failed: Result<Arc<String>> = once.get("other", || anyhow::bail!("no"));
        assert!(failed.is_err() && *once.get("other", || Ok("yes".to_owned())).unwrap() == "yes");
    }
}
