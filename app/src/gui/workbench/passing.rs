//! What nobody wants back after a restart.

use crate::gui::exports::Exports;
use crate::gui::palette::Palette;
use crate::gui::pane::Pane;
use crate::gui::shelf::{Errand, Opener};

/// What is open over the panes, and what they asked for.
#[derive(Default)]
pub(super) struct Passing {
    pub palette: Option<Palette>,
    pub is_helping: bool,
    pub is_searching: bool,
    /// Whether a text had the focus in the last frame: Esc takes it away before anything else is asked.
    pub was_typing: bool,
    pub exports: Option<Exports>,
    /// The pane that was entered last, and whether it is to have the focus.
    pub entered: Option<Pane>,
    pub is_entering: bool,
    pub opener: Opener,
    pub errands: Vec<Errand>,
}
