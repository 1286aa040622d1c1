//! The desktop app: two materials, the ways between them, side by side and live.
//!
//! [`Session`] is what the user chose, [`Gallery`] what the worker answered, [`Layout`] where the panes are;
//! [`Workbench`] brings them together. A [pane](pane::Pane) borrows what it shows; an [action](action::Action) is
//! something that can be done by key, button or name. The window is a thin shell around it, so that tests drive
//! everything without one. No pane evaluates a material: that is the [worker](crate::worker)'s.

pub mod action;
pub mod args;
mod atlas;
mod card;
mod cards;
mod curves;
pub mod drag;
mod exports;
mod framing;
mod gallery;
mod header;
mod help;
mod history;
mod layout;
mod look;
mod notices;
mod palette;
pub mod pane;
mod pick;
mod picture;
mod put;
mod renderer;
pub mod reproduce;
mod scrubber;
pub mod session;
mod shelf;
mod stage;
mod start;
mod status;
pub mod store;
mod strips;
mod travel;
mod window;
mod workbench;

use std::path::PathBuf;

use anyhow::Result;

pub use args::App;
pub use atlas::Atlas;
pub use curves::Curves;
pub use exports::Files;
pub use gallery::Gallery;
pub use layout::Layout;
pub use renderer::Renderer;
pub use session::Session;
pub use workbench::Workbench;

/// Opens the app on the built-in library and the materials in these files; returns when its window is closed.
///
/// # Errors
/// If there is no display to open a window on.
pub fn run(extra_files: Vec<PathBuf>) -> Result<()> {
    App { files: extra_files, ..App::default() }.run()
}
