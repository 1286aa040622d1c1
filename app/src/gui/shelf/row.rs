//! A material as a row: picture, name, where it comes from, and what it is sorted by.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Rect, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};
use nbrdf_core::{Database, Split};

use super::{entry, star, value};
use crate::gui::session::{letter, shown};
use crate::gui::{Gallery, Session, look};

/// Height of a row \[points\].
pub const HEIGHT: f32 = 52.0;
const THUMBNAIL: f32 = 44.0;
/// Room for the buttons on the right.
const BUTTONS: f32 = 62.0;

/// One row.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery, name: &str) {
    let (rect, row) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click_and_drag());
    let chosen = [0, 1].map(|end| session.blend.ends[end] == name);
    row.widget_info(|| WidgetInfo::selected(egui::Role::ListItem, true, chosen[0] || chosen[1], name));
    let sort = session.listing.sort;
    let value = value(sort, gallery, name).map(|value| sort.shown(value));
    let lines = [shown(name).to_owned(), about(name, gallery, value.as_deref())];
    paint(ui, rect, &row, &lines, chosen[0] || chosen[1]);
    let thumbnail = Rect::from_min_size(rect.min + vec2(4.0, 4.0), vec2(THUMBNAIL, THUMBNAIL));
    entry::picture(ui, gallery, name, thumbnail);
    star::show(ui, &mut session.listing, rect.min, name, row.contains_pointer() || row.has_focus());
    for end in [0, 1] {
        let centre = rect.right_center() - vec2(44.0 - 26.0 * end as f32, 0.0);
        let place = Rect::from_center_size(centre, vec2(24.0, 24.0));
        let button = ui.interact(place, ui.scope_id().with(("end", end)), Sense::click());
        let label = format!("{name} as {}", letter(end));
        button.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, chosen[end], &label));
        let lit = chosen[end] || button.hovered() || button.has_focus();
        look::badge(ui.painter(), centre, end, lit, ui.visuals());
        if button.on_hover_text(label).clicked() {
            session.blend.choose(end, name);
        }
    }
    let row = row.on_hover_text(format!("{name}\n{}", lines[1]));
    entry::interact(ui, session, gallery, &row, name);
}

fn paint(ui: &Ui, rect: Rect, row: &Response, lines: &[String; 2], is_chosen: bool) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    if is_chosen || row.hovered() || row.has_focus() {
        painter.rect_filled(rect, look::ROUND, visuals.faint_bg_color);
    }
    if row.has_focus() {
        let stroke = Stroke::new(1.5, visuals.selection.stroke.color);
        painter.rect_stroke(rect, look::ROUND, stroke, StrokeKind::Inside);
    }
    let left = rect.left() + THUMBNAIL + 12.0;
    let line = |text: &str, size: f32, colour: Color32, y: f32| {
        let mut job = LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), colour);
        job.wrap = TextWrapping::truncate_at_width((rect.right() - BUTTONS - left).max(0.0));
        let galley = painter.layout_job(job);
        painter.galley(pos2(left, rect.center().y + y - galley.size().y / 2.0), galley, colour);
    };
    line(&lines[0], 13.5, visuals.text_color(), -8.0);
    line(&lines[1], 11.0, visuals.weak_text_color(), 9.0);
}

/// What the list is sorted by first: it must be seen where there is little room.
fn about(name: &str, gallery: &Gallery, value: Option<&str>) -> String {
    let origin = origin(name, gallery);
    value.map_or_else(|| origin.clone(), |value| format!("{value} · {origin}"))
}

fn origin(name: &str, gallery: &Gallery) -> String {
    let held_out = if Split::of(name) == Split::HeldOut { ", held out" } else { "" };
    let file = gallery.sources.get(name).and_then(|path| path.file_name());
    match (Database::of(name), file) {
        (_, Some(file)) => file.to_string_lossy().into_owned(),
        (Database::Merl, None) => format!("MERL{held_out}"),
        (Database::Rgl, None) => format!("RGL{held_out}"),
        (Database::Other, None) => "own".to_owned(),
    }
}
