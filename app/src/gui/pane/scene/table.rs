//! What every object got, and why.

use std::sync::Arc;

use egui::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Galley, Rect, Response, Sense, Ui, WidgetInfo, pos2, vec2};

use crate::gui::look;
use crate::gui::session::Scene;
use crate::report::figure;
use crate::worker::scene::{Planned, Row};

const LINE: f32 = 19.0;
const MARGIN: f32 = 6.0;
/// Below this width, figures stand on a line of their own \[points\].
const NARROW: f32 = 400.0;
/// Name, share of the width, what it means.
const COLUMNS: [(&str, f32, &str); 6] = [
    ("object", 0.22, "Name of the object"),
    ("material", 0.25, "Name of its material"),
    ("model", 0.21, "The chosen kind of model; itself is the material as it is"),
    ("FLIP", 0.11, "Mean FLIP on the object's pixels, everything planned: 0 is no difference, 1 the largest"),
    ("ns", 0.09, "Nanoseconds per evaluation on the directions of the picture, one thread"),
    ("bytes", 0.12, "Bytes of the material, without what several share"),
];

/// The table; a click selects.
pub fn show(ui: &mut Ui, scene: &mut Scene, plan: &Planned) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let is_narrow = ui.available_width() < NARROW;
    if !is_narrow {
        head(ui);
    }
    for row in &plan.rows {
        let is_selected = scene.selected.as_ref() == Some(&row.object);
        let response = ui.push_id(&row.object, |ui| line(ui, row, is_selected, is_narrow)).inner;
        if response.clicked() {
            scene.select(&row.object);
        }
    }
}

fn head(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), LINE), Sense::hover());
    let colour = ui.visuals().weak_text_color();
    for ((name, _, about), place) in COLUMNS.iter().zip(columns(rect)) {
        let column = ui.interact(place, ui.scope_id().with(("head", name)), Sense::hover());
        column.widget_info(|| WidgetInfo::labeled(egui::Role::ColumnHeader, true, *name));
        let galley = single(ui, name, 11.5, colour, place.width());
        ui.painter().galley(pos2(place.left(), place.center().y - galley.size().y / 2.0), galley, colour);
        column.on_hover_text(*about);
    }
}

fn line(ui: &mut Ui, row: &Row, is_selected: bool, is_narrow: bool) -> Response {
    let width = ui.available_width();
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let reason = ui.painter().layout(row.reason.clone(), FontId::proportional(11.5), weak, width - 2.0 * MARGIN);
    let lines = if is_narrow { 2.0 } else { 1.0 };
    let (rect, response) = ui.allocate_exact_size(vec2(width, lines * LINE + reason.size().y + MARGIN), Sense::click());
    let figures = format!("FLIP {}, {} ns, {} bytes", figure(row.error), figure(row.ns), row.bytes);
    let told = format!("{}, {}: {}, {figures}", row.object, row.material, row.model);
    response.widget_info(|| WidgetInfo::selected(egui::Role::ListItem, true, is_selected, told.as_str()));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    ground(ui, rect, &response, is_selected);
    let first = Rect::from_min_size(rect.min, vec2(width, LINE));
    let put = |place: Rect, what: &str, colour: Color32| {
        let galley = single(ui, what, 12.5, colour, place.width());
        ui.painter().galley(pos2(place.left(), place.center().y - galley.size().y / 2.0), galley, colour);
    };
    if is_narrow {
        let inner = first.shrink2(vec2(MARGIN, 0.0));
        put(inner, &format!("{}: {}", row.object, row.model), text);
        put(inner.translate(vec2(0.0, LINE)), &figures, text);
    } else {
        let cells =
            [&row.object, &row.material, &row.model, &figure(row.error), &figure(row.ns), &row.bytes.to_string()];
        for (what, place) in cells.into_iter().zip(columns(first)) {
            put(place, what, text);
        }
    }
    ui.painter().galley(rect.min + vec2(MARGIN, lines * LINE), reason, weak);
    response.on_hover_text(format!("{told}\n{}", row.reason))
}

fn ground(ui: &Ui, rect: Rect, response: &Response, is_selected: bool) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    if is_selected {
        painter.rect_filled(rect, look::ROUND, visuals.selection.bg_fill.gamma_multiply(0.5));
    } else if response.hovered() {
        painter.rect_filled(rect, look::ROUND, visuals.faint_bg_color);
    }
    look::focus(painter, response, visuals);
}

/// Places of the columns.
fn columns(rect: Rect) -> impl Iterator<Item = Rect> {
    let whole = rect.shrink2(vec2(MARGIN, 0.0));
    COLUMNS.iter().scan(whole.left(), move |left, (_, share, _)| {
        let from = *left;
        *left += share * whole.width();
        Some(Rect::from_min_max(pos2(from, whole.top()), pos2(*left - 4.0, whole.bottom())))
    })
}

fn single(ui: &Ui, text: &str, size: f32, colour: Color32, width: f32) -> Arc<Galley> {
    let mut job = LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), colour);
    job.wrap = TextWrapping::truncate_at_width(width.max(1.0));
    ui.painter().layout_job(job)
}
