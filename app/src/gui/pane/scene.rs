//! A scene, planned: what every object got and why, and what the picture becomes.

mod picture;
mod plan;
mod table;
mod top;

use egui::{Rect, RichText, ScrollArea, Ui, UiBuilder, vec2};

use crate::gui::{Gallery, Session};
use crate::worker::scene::Ask;

/// Picture and table stand side by side from this width on \[points\].
const WIDE: f32 = 460.0;
/// Of the height, for a picture with the table below it: some of that is to be seen, too.
const SHARE: f32 = 0.7;

/// One frame; what is asked of the worker.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) -> Ask {
    let tableau = &gallery.scene;
    top::open(ui, &mut session.scene);
    if session.scene.source.is_none() {
        ui.add_space(16.0);
        let text = "Drop a scene (.toml) on this window, give the path of one above, or take an example.";
        ui.label(RichText::new(text).weak());
        return Ask::Nothing;
    }
    let asked = top::state(ui, tableau);
    let whole = ui.available_rect_before_wrap();
    let Some(size) = tableau.size() else { return asked.unwrap_or(Ask::Plan) };
    let mut is_waiting = false;
    if whole.width() >= WIDE {
        let middle = whole.left() + (0.5 * whole.width()).round();
        let left = Rect::from_min_max(whole.min, egui::pos2(middle - 6.0, whole.bottom()));
        let right = Rect::from_min_max(egui::pos2(middle + 6.0, whole.top()), whole.max);
        ui.scope_builder(UiBuilder::new().max_rect(left).id_salt("picture"), |ui| {
            picture::show(ui, &mut session.scene, tableau, size, left.height());
        });
        ui.scope_builder(UiBuilder::new().max_rect(right).id_salt("plan"), |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| is_waiting = plan::show(ui, session, gallery));
        });
    } else {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            picture::show(ui, &mut session.scene, tableau, size, SHARE * whole.height());
            ui.allocate_space(vec2(0.0, 4.0));
            is_waiting = plan::show(ui, session, gallery);
        });
    }
    asked.unwrap_or(if is_waiting { Ask::Nothing } else { Ask::Plan })
}
