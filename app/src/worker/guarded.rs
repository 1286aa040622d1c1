//! Work that may panic.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a job; a panic becomes a message, so that it does not take the window down.
pub(super) fn guarded<T>(what: &str, job: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(job)).map_err(|panic| {
        let said = panic.downcast_ref::<String>().map(String::as_str);
        let said = said.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        format!("{what} failed unexpectedly: {said}")
    })
}
