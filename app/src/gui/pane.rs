//! The panes, and what each of them borrows.

mod inspector;
mod path;

use egui::{Frame, Margin, Ui};
use serde::{Deserialize, Serialize};

use super::cards::Cards;
use super::shelf::Shelf;
use super::{Gallery, Session};

/// A part of the window that can be moved about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Pane {
    /// All materials.
    Library,
    /// The spheres.
    Stage,
    /// The way between the materials.
    Path,
    /// Light, exposure, and what else changes the look.
    Inspector,
}

impl Pane {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Library, Self::Stage, Self::Path, Self::Inspector];
    /// Those below the stage.
    pub const BELOW: [Self; 1] = [Self::Path];
    /// Those on the right.
    pub const RIGHT: [Self; 1] = [Self::Inspector];

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Library => "Library",
            Self::Stage => "Stage",
            Self::Path => "Path",
            Self::Inspector => "Inspector",
        }
    }
}

/// What the panes of one frame show and change.
pub struct Desk<'a> {
    /// What the user chose.
    pub session: &'a mut Session,
    /// What the worker answered.
    pub gallery: &'a Gallery,
    /// Whether the search field is to have the focus.
    pub is_searching: &'a mut bool,
    /// Asked for in this frame.
    pub wanted: Wanted,
}

/// Pictures that the panes have room for \[points\]; 0 for none.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted {
    /// Side of a sphere.
    pub side: f32,
    /// Side of a frame of a film strip.
    pub frame: f32,
}

impl Desk<'_> {
    /// One frame of a pane.
    pub fn show(&mut self, ui: &mut Ui, pane: Pane) {
        let fill = ui.visuals().panel_fill;
        let margin = match pane {
            Pane::Stage => Margin::same(8),
            _ => Margin::symmetric(10, 8),
        };
        Frame::new().fill(fill).inner_margin(margin).show(ui, |ui| {
            ui.set_min_size(ui.available_size());
            match pane {
                Pane::Library => {
                    Shelf { session: self.session, gallery: self.gallery, is_searching: self.is_searching }.show(ui)
                }
                Pane::Stage => {
                    self.wanted.side = Cards { session: self.session, gallery: self.gallery }.show(ui);
                }
                Pane::Path => self.wanted.frame = path::show(ui, self.session, self.gallery),
                Pane::Inspector => inspector::show(ui, self.session, &self.gallery.maps),
            }
        });
    }
}
