//! The panes, and what each of them borrows.

mod figures;
mod inspector;
mod map;
mod path;
mod point;
mod scene;
mod view;

use egui::{Frame, Id, Margin, Sense, StrokeKind, Ui, WidgetInfo};
use serde::{Deserialize, Serialize};

use super::shelf::{Errand, Opener, Shelf};
use super::stage::Stage;
use super::{Gallery, Session, look};
use crate::worker::scene::Ask;
use crate::worker::{Inquiry, Topic};

/// A part of the window that can be moved about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Pane {
    /// All materials.
    Library,
    /// The spheres.
    Stage,
    /// The way between the materials.
    Path,
    /// Curves, slices, costs and warnings.
    Figures,
    /// A scene, and the cheapest models that serve it.
    Scene,
    /// Light, exposure, and what else changes the look.
    Inspector,
    /// Directions and values at one place of the spheres.
    Point,
    /// All materials by their codes.
    Map,
}

impl Pane {
    /// All of them.
    pub const ALL: [Self; 8] =
        [Self::Library, Self::Stage, Self::Path, Self::Figures, Self::Map, Self::Scene, Self::Inspector, Self::Point];
    /// Those below the stage.
    pub const BELOW: [Self; 4] = [Self::Path, Self::Figures, Self::Map, Self::Scene];
    /// Those on the right.
    pub const RIGHT: [Self; 2] = [Self::Inspector, Self::Point];

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Library => "Library",
            Self::Stage => "Stage",
            Self::Path => "Path",
            Self::Figures => "Figures",
            Self::Map => "Map",
            Self::Scene => "Scene",
            Self::Inspector => "Inspector",
            Self::Point => "Point",
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
    /// The pane that is to have the focus.
    pub(super) entering: &'a mut Option<Pane>,
    /// Where paths of files are typed.
    pub(super) opener: &'a mut Opener,
    /// What the library cannot do itself.
    pub(super) errands: &'a mut Vec<Errand>,
    /// Asked for in this frame.
    pub wanted: Wanted,
}

/// What the panes ask for: pictures they have room for \[points\], 0 for none, and figures.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Side of a sphere.
    pub side: f32,
    /// Side of a frame of a film strip.
    pub frame: f32,
    /// Whether the picked point is looked at.
    pub is_point: bool,
    /// The figure that is seen.
    pub figure: Option<Topic>,
    /// Whether the chart of all representations is to be made, or to be stopped.
    pub is_charting: Option<bool>,
    /// Whether the latent map is shown.
    pub is_map: bool,
    /// Of the scene.
    pub scene: Ask,
    /// Whether the qualities of points are shown.
    pub is_measured: bool,
    /// What the library is sorted by.
    pub inquiry: Option<Inquiry>,
}

impl Desk<'_> {
    /// One frame of a pane.
    pub fn show(&mut self, ui: &mut Ui, pane: Pane) {
        let margin = match pane {
            Pane::Stage => Margin::same(8),
            _ => Margin::symmetric(10, 8),
        };
        Frame::new().inner_margin(margin).show(ui, |ui| {
            ui.set_min_size(ui.available_size());
            self.focus(ui, pane);
            match pane {
                Pane::Library => {
                    let shelf = Shelf {
                        session: self.session,
                        gallery: self.gallery,
                        is_searching: self.is_searching,
                        opener: self.opener,
                        errands: self.errands,
                    };
                    self.wanted.inquiry = shelf.show(ui);
                }
                Pane::Stage => {
                    self.wanted.side = Stage { session: self.session, gallery: self.gallery }.show(ui);
                }
                Pane::Path => self.wanted.frame = path::show(ui, self.session, self.gallery),
                Pane::Figures => figures::show(ui, self.session, self.gallery, &mut self.wanted),
                Pane::Map => {
                    self.wanted.is_map = true;
                    map::show(ui, self.session, self.gallery);
                }
                Pane::Scene => self.wanted.scene = scene::show(ui, self.session, self.gallery),
                Pane::Point => {
                    self.wanted.is_point = true;
                    point::show(ui, self.session, self.gallery);
                }
                Pane::Inspector => self.wanted.is_measured = inspector::show(ui, self.session, self.gallery),
            }
        });
    }

    /// The pane itself as something that takes the focus: it is reached by keys, and Tab leads into it.
    fn focus(&mut self, ui: &Ui, pane: Pane) {
        let whole = ui.interact(ui.max_rect(), Id::unique(("pane", pane)), Sense::focusable_noninteractive());
        whole.widget_info(|| WidgetInfo::labeled(egui::Role::Group, true, format!("{} pane", pane.title())));
        if self.entering.take_if(|entering| *entering == pane).is_some() {
            whole.request_focus();
        }
        if whole.has_focus() {
            look::ring(ui.painter(), ui.max_rect().expand(4.0), StrokeKind::Inside, ui.visuals());
        }
    }
}
