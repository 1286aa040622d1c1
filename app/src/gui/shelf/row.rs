//! A material as a row: picture, name, where it comes from, and what it is sorted by.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Rect, Response, Sense, Ui, WidgetInfo, pos2, vec2};
use nbrdf_core::{Database, Split};

use super::{entry, star, value};
use crate::gui::session::{letter, shown};
use crate::gui::{Gallery, Session, look, picture};

/// Height of a row \[points\].
pub const HEIGHT: f32 = 52.0;
const THUMBNAIL: f32 = 44.0;
/// Room for the buttons on the right.
const BUTTONS: f32 = 62.0;
/// From one mark to the next \[points\].
const STEP: f32 = 20.0;

/// One row.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery, name: &str) {
    let (rect, row) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click_and_drag());
    let slots = session.blend.slots_of(name);
    row.widget_info(|| WidgetInfo::selected(egui::Role::ListItem, true, !slots.is_empty(), name));
    let sort = session.listing.sort;
    let value = value(sort, gallery, name).map(|value| sort.shown(value));
    let lines = [shown(name).to_owned(), about(name, gallery, value.as_deref())];
    ground(ui, rect, &row, !slots.is_empty());
    // A and B are buttons; where else the material is, is marked beside them.
    let others: Vec<usize> = slots.iter().copied().filter(|slot| *slot > 1).collect();
    let marks = STEP * others.len() as f32;
    paint(ui, rect.with_max_x(rect.right() - BUTTONS - marks), &lines);
    for (place, &slot) in others.iter().rev().enumerate() {
        let centre = rect.right_center() - vec2(44.0 + STEP * (place + 1) as f32, 0.0);
        look::badge(ui.painter(), centre, slot, true, ui.visuals());
    }
    let thumbnail = Rect::from_min_size(rect.min + vec2(4.0, 4.0), vec2(THUMBNAIL, THUMBNAIL));
    picture::ball(ui.painter(), gallery.thumbnail(name), thumbnail, ui.visuals());
    star::show(ui, &mut session.listing, rect.min, name, row.contains_pointer() || row.has_focus());
    for end in [0, 1] {
        let centre = rect.right_center() - vec2(44.0 - 26.0 * end as f32, 0.0);
        let place = Rect::from_center_size(centre, vec2(24.0, 24.0));
        let button = ui.interact(place, ui.scope_id().with(("end", end)), Sense::click());
        let label = format!("{name} as {}", letter(end));
        let is_here = slots.contains(&end);
        button.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, is_here, &label));
        let lit = is_here || button.hovered() || button.has_focus();
        look::badge(ui.painter(), centre, end, lit, ui.visuals());
        if button.on_hover_text(label).clicked() {
            session.blend.choose(end, name);
        }
    }
    let row = row.on_hover_text(format!("{name}{}\n{}", entry::whereabouts(&slots), lines[1]));
    entry::interact(ui, session, gallery, &row, name);
}

/// Under what is chosen, pointed at or in focus.
fn ground(ui: &Ui, rect: Rect, row: &Response, is_chosen: bool) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    if is_chosen || row.hovered() || row.has_focus() {
        painter.rect_filled(rect, look::ROUND, visuals.faint_bg_color);
    }
    look::focus(painter, row, visuals);
}

/// Two lines beside the picture, as far as there is room.
fn paint(ui: &Ui, rect: Rect, lines: &[String; 2]) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let left = rect.left() + THUMBNAIL + 12.0;
    let line = |text: &str, size: f32, colour: Color32, y: f32| {
        let mut job = LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), colour);
        job.wrap = TextWrapping::truncate_at_width((rect.right() - left).max(0.0));
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
