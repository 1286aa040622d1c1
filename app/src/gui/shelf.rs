//! The left panel: every material, to be put at A or at B.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Color32, FontId, Key, Rect, Response, RichText, ScrollArea, Sense, TextEdit, Ui, WidgetInfo, pos2, vec2};
use nbrdf_core::{Database, Split};

use super::session::letter;
use super::{Gallery, Session, look};

const ROW: f32 = 52.0;
const THUMBNAIL: f32 = 44.0;

/// The left panel.
pub struct Shelf<'a> {
    pub session: &'a mut Session,
    pub gallery: &'a Gallery,
    /// Whether the search field is to have the focus.
    pub is_searching: &'a mut bool,
}

impl Shelf<'_> {
    pub fn show(mut self, ui: &mut Ui) {
        self.search(ui);
        ui.add_space(2.0);
        let listed: Vec<&str> =
            self.gallery.names.iter().map(String::as_str).filter(|name| self.session.listing.lists(name)).collect();
        if listed.is_empty() {
            ui.add_space(24.0);
            ui.vertical_centered(|ui| ui.label(RichText::new("No material has such a name.").weak()));
        }
        ui.spacing_mut().item_spacing.y = 2.0;
        ScrollArea::vertical().auto_shrink(false).show_rows(ui, ROW, listed.len(), |ui, range| {
            for name in &listed[range] {
                ui.push_id(name, |ui| self.row(ui, name));
            }
        });
    }

    fn search(&mut self, ui: &mut Ui) {
        let hint = format!("Search {} materials", self.gallery.names.len());
        let field = TextEdit::singleline(&mut self.session.listing.search)
            .hint_text(hint)
            .desired_width(f32::INFINITY)
            .margin(vec2(8.0, 6.0));
        let field = ui.add(field).on_hover_text("Words in any order (Ctrl+F)");
        if std::mem::take(self.is_searching) {
            field.request_focus();
        }
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let own = self.gallery.names.iter().any(|name| Database::of(name) == Database::Other);
            let choices = [
                (None, "All"),
                (Some(Database::Merl), "MERL"),
                (Some(Database::Rgl), "RGL"),
                (Some(Database::Other), "Own"),
            ];
            for (database, name) in choices.into_iter().take(if own { 4 } else { 3 }) {
                ui.selectable_value(&mut self.session.listing.database, database, name);
            }
        });
        ui.label(RichText::new("Click for A, shift-click for B").small().weak());
    }

    fn row(&mut self, ui: &mut Ui, name: &str) {
        let (rect, row) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
        let chosen = [0, 1].map(|end| self.session.blend.ends[end] == name);
        row.widget_info(|| WidgetInfo::selected(egui::Role::ListItem, true, chosen[0] || chosen[1], name));
        self.paint(ui, rect, &row, name, chosen);
        let mut choice = None;
        for end in [0, 1] {
            let centre = rect.right_center() - vec2(44.0 - 26.0 * end as f32, 0.0);
            let button = ui.put(Rect::from_center_size(centre, vec2(24.0, 24.0)), |ui: &mut Ui| {
                ui.allocate_response(vec2(24.0, 24.0), Sense::click())
            });
            let label = format!("{name} as {}", letter(end));
            button.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, chosen[end], &label));
            let lit = chosen[end] || button.hovered() || button.has_focus();
            look::badge(ui.painter(), centre, end, lit, ui.visuals());
            if button.on_hover_text(label).clicked() {
                choice = Some(end);
            }
        }
        let (shift, a, b) =
            ui.input(|input| (input.modifiers.shift, input.key_pressed(Key::A), input.key_pressed(Key::B)));
        let row = row.on_hover_text(name);
        if row.clicked() {
            choice = Some(usize::from(shift));
        } else if row.has_focus() && (a || b) {
            choice = Some(usize::from(b));
        }
        if let Some(end) = choice {
            self.session.blend.choose(end, name);
        }
    }

    fn paint(&self, ui: &Ui, rect: Rect, row: &Response, name: &str, chosen: [bool; 2]) {
        let (painter, visuals) = (ui.painter(), ui.visuals());
        if chosen[0] || chosen[1] || row.hovered() || row.has_focus() {
            painter.rect_filled(rect, look::ROUND, visuals.faint_bg_color);
        }
        if row.has_focus() {
            let stroke = egui::Stroke::new(1.5, visuals.selection.stroke.color);
            painter.rect_stroke(rect, look::ROUND, stroke, egui::StrokeKind::Inside);
        }
        let thumbnail = Rect::from_min_size(rect.min + vec2(4.0, 4.0), vec2(THUMBNAIL, THUMBNAIL));
        match self.gallery.thumbnail(name) {
            Some(texture) => {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                painter.image(texture.id(), thumbnail, whole, Color32::WHITE);
            }
            None => {
                painter.circle_filled(thumbnail.center(), THUMBNAIL / 2.0, visuals.faint_bg_color);
            }
        }
        let left = thumbnail.right() + 8.0;
        let line = |text: &str, size: f32, colour: Color32, y: f32| {
            let mut job = LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(size), colour);
            job.wrap = TextWrapping::truncate_at_width(rect.right() - 62.0 - left);
            let galley = painter.layout_job(job);
            painter.galley(pos2(left, rect.center().y + y - galley.size().y / 2.0), galley, colour);
        };
        line(name.strip_prefix("rgl/").unwrap_or(name), 13.5, visuals.text_color(), -8.0);
        line(&origin(name), 11.0, visuals.weak_text_color(), 9.0);
    }
}

fn origin(name: &str) -> String {
    let held_out = if Split::of(name) == Split::HeldOut { ", held out" } else { "" };
    match Database::of(name) {
        Database::Merl => format!("MERL{held_out}"),
        Database::Rgl => format!("RGL{held_out}"),
        Database::Other => "own".to_owned(),
    }
}
