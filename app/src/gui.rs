//! The desktop app: two materials, the ways between them, side by side and live.
//!
//! [`Session`] is what the user chose, [`Gallery`] what the worker answered; [`Workbench`] brings them together, and
//! each panel is a struct that borrows what it shows. The window is a thin shell around it, so that tests drive
//! everything without one. No panel evaluates a material: that is the [worker](crate::worker)'s.

pub mod args;
mod card;
mod cards;
mod controls;
mod gallery;
mod header;
mod look;
mod notices;
mod scrubber;
pub mod session;
mod shelf;
mod status;
mod strips;
mod window;
mod workbench;

use std::path::PathBuf;

use anyhow::Result;

pub use args::App;
pub use gallery::Gallery;
pub use session::{End, Session};
pub use workbench::Workbench;

/// Opens the app on the built-in library and the materials in these files; returns when its window is closed.
///
/// # Errors
/// If there is no display to open a window on.
pub fn run(extra_files: Vec<PathBuf>) -> Result<()> {
    App { files: extra_files, ..App::default() }.run()
}
