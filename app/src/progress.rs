//! Progress of long commands: bars on a terminal, nothing elsewhere; Ctrl-C asks the work to stop cleanly.

use std::io::IsTerminal;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Result, bail};
use indicatif::{ProgressBar, ProgressStyle};

/// A bar of `length` steps on stderr; hidden when quiet or when stderr is no terminal.
pub fn bar(length: u64, what: &str, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(length);
    let template = "{prefix:>12} {bar:32} {pos}/{len} {msg} {elapsed} (left {eta})";
    bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_prefix(what.to_owned());
    bar
}

/// A sign of life for work of unknown length.
pub fn spinner(what: &str, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let spinner = ProgressBar::new_spinner();
    let template = "{prefix:>12} {spinner} {pos} {msg} {elapsed}";
    spinner.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_spinner()));
    spinner.set_prefix(what.to_owned());
    spinner
}

/// Whether the user has asked to stop; the first call starts listening for Ctrl-C.
pub fn cancelled() -> bool {
    static LISTENING: OnceLock<()> = OnceLock::new();
    static STOP: AtomicBool = AtomicBool::new(false);
    LISTENING.get_or_init(|| {
        // Where no handler can be set, Ctrl-C simply ends the program; files are whole either way.
        let _ = ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed));
    });
    STOP.load(Ordering::Relaxed)
}

/// Ends the work when the user has asked to stop.
pub fn check() -> Result<()> {
    if cancelled() { bail!("cancelled") } else { Ok(()) }
}
