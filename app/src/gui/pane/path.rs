//! The path: which materials, where between them, and whole paths as film strips below.

mod kept;
mod materials;
mod player;
mod polygon;
mod slots;
mod timing;
mod weights;

use egui::{Label, Rangef, RichText, ScrollArea, Ui, vec2};

use super::Pane;
use crate::gui::scrubber::Scrubber;
use crate::gui::session::Way;
use crate::gui::strips::{self, Strips};
use crate::gui::{Gallery, Session};

/// Room that two choices beside each other want, so that no line breaks between them \[points\].
const PAIR: f32 = 150.0;
/// Sides of the polygon's area \[points\].
const POLYGON: [f32; 2] = [130.0, 260.0];

/// The side of a strip's frame that there is room for \[points\], 0 for none.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) -> f32 {
    let height = ui.available_height();
    ScrollArea::vertical()
        .id_salt(Pane::Path)
        .auto_shrink(false)
        .show(ui, |ui| {
            let top = ui.cursor().top();
            ui.horizontal_wrapped(|ui| {
                slots::show(ui, session, gallery);
                way(ui, session);
                if !session.blend.is_polygon() {
                    timing::show(ui, &mut session.blend);
                }
                kept::show(ui, session);
                if session.blend.is_outside() {
                    ui.label(RichText::new("beyond the ends").small().color(ui.visuals().warn_fg_color));
                }
            });
            let rail = if session.blend.is_polygon() {
                let side = (0.5 * height).clamp(POLYGON[0], POLYGON[1]).min(ui.available_width());
                ui.horizontal_wrapped(|ui| {
                    polygon::show(ui, &mut session.blend, gallery, side);
                    ui.vertical(|ui| {
                        player::show(ui, session);
                        weights::show(ui, &mut session.blend);
                    });
                });
                None
            } else {
                Some(along(ui, session))
            };
            if session.strips && !session.methods.0.is_empty() {
                let left = height - (ui.cursor().top() - top);
                strip(ui, session, gallery, left, rail)
            } else {
                0.0
            }
        })
        .inner
}

/// The way as a line; where its rail lies.
fn along(ui: &mut Ui, session: &mut Session) -> Rangef {
    ui.horizontal(|ui| {
        player::show(ui, session);
        let is_outside = session.blend.is_outside();
        let mut value = RichText::new(format!("t = {:.3}", session.blend.t)).size(14.0);
        if is_outside {
            value = value.color(ui.visuals().warn_fg_color);
        }
        let value = ui.add_sized(vec2(68.0, 26.0), Label::new(value));
        if is_outside {
            value.on_hover_text("Beyond the ends: a guess, no mixture of what is known");
        } else {
            value.on_hover_text("Place on the path: 0 is the first material, 1 the last");
        }
        Scrubber { session }.show(ui)
    })
    .inner
}

/// Begins a line where this one has no room for two choices.
fn keep_together(ui: &mut Ui) {
    if ui.available_size_before_wrap().x < PAIR {
        ui.end_row();
    }
}

/// Along a path or within a polygon, of three materials and more.
fn way(ui: &mut Ui, session: &mut Session) {
    let blend = &mut session.blend;
    if blend.ends.len() < 3 {
        return;
    }
    keep_together(ui);
    let choices = [
        (Way::Keys, "Keys", "From one material to the next, along a smooth curve"),
        (Way::Polygon, "Polygon", "Freely between all materials, one at each corner"),
    ];
    for (way, name, about) in choices {
        if ui.selectable_label(blend.way == way, name).on_hover_text(about).clicked() && blend.way != way {
            blend.way = way;
            blend.playing = None;
        }
    }
}

/// Film strips; below a rail their frames stand where their t is on it.
fn strip(ui: &mut Ui, session: &mut Session, gallery: &Gallery, height: f32, rail: Option<Rangef>) -> f32 {
    let pixel = 1.0 / ui.pixels_per_point();
    let frames = session.blend.tour().frames(session.blend.ends.len());
    let available = vec2(ui.available_width(), height);
    let right = ui.available_rect_before_wrap().right();
    let frame = strips::fit(available, session.methods.0.len(), frames, rail.map(|rail| (rail, right - rail.max)));
    let frame = (frame / pixel).floor() * pixel;
    Strips { session, gallery, frame, rail }.show(ui);
    frame
}
