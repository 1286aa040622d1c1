//! What is learned when it is first asked for.

use std::any::Any;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::Result;

/// Learned parts, each learned once.
#[derive(Default)]
pub(super) struct Once(Mutex<Vec<(&'static str, Arc<dyn Any + Send + Sync>)>>);

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
        if let Some(known) = self.known(name) {
            return Ok(known);
        }
        // Not under the lock: learning is parallel, and a thread that waits in it may be handed a task that asks here.
        let learned = Arc::new(learn()?);
        if let Some(known) = self.known(name) {
            return Ok(known);
        }
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push((name, Arc::clone(&learned) as _));
        Ok(learned)
    }

    fn known<T: Send + Sync + 'static>(&self, name: &str) -> Option<Arc<T>> {
        let all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (_, found) = all.iter().find(|(known, _)| *known == name)?;
        Arc::clone(found).downcast().ok()
    }
}
