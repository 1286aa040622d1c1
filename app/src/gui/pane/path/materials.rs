//! A small list of all materials that opens at a button, with a field to search it.

use egui::{
    Align2, FontId, Id, Key, Popup, PopupCloseBehavior, Rect, Response, RichText, ScrollArea, Sense, TextEdit, Ui,
    WidgetInfo, vec2,
};

use crate::gui::session::{Listing, shown};
use crate::gui::{Gallery, look, picture};

const ROW: f32 = 28.0;
const WIDTH: f32 = 220.0;

/// The material that was chosen from the list of this button; a click on the button opens and closes it.
pub fn choose(button: &Response, gallery: &Gallery) -> Option<String> {
    let search = button.id.with("search");
    if button.clicked() {
        button.ctx.data_mut(|data| data.remove::<String>(search));
    }
    let popup = Popup::from_toggle_button_response(button).close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let chosen = popup.show(|ui| list(ui, gallery, search, button.clicked()))?.inner;
    if chosen.is_some() {
        Popup::close_id(&button.ctx, Popup::default_response_id(button));
    }
    chosen
}

fn list(ui: &mut Ui, gallery: &Gallery, search: Id, is_new: bool) -> Option<String> {
    ui.set_width(WIDTH);
    let mut text = ui.data(|data| data.get_temp::<String>(search)).unwrap_or_default();
    let field = ui.add(TextEdit::singleline(&mut text).hint_text("Search").desired_width(f32::INFINITY));
    if is_new {
        field.request_focus();
    }
    let listing = Listing { search: text.clone(), ..Listing::default() };
    ui.data_mut(|data| data.insert_temp(search, text));
    let listed: Vec<&String> = gallery.names.iter().filter(|name| listing.lists(name)).collect();
    if listed.is_empty() {
        ui.label(RichText::new("No material has such a name.").weak());
    }
    // Enter takes the first that is found.
    let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let mut chosen = listed.first().filter(|_| is_entered).map(|name| (*name).clone());
    ui.spacing_mut().item_spacing.y = 1.0;
    ScrollArea::vertical().max_height(260.0).show_rows(ui, ROW, listed.len(), |ui, range| {
        for name in &listed[range] {
            if row(ui, gallery, name).clicked() {
                chosen = Some((*name).clone());
            }
        }
    });
    chosen
}

fn row(ui: &mut Ui, gallery: &Gallery, name: &str) -> Response {
    let (rect, row) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    row.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Take {name}")));
    let (painter, visuals) = (ui.painter(), ui.visuals());
    if row.hovered() || row.has_focus() {
        painter.rect_filled(rect, look::ROUND, visuals.selection.bg_fill);
    }
    let ball = Rect::from_center_size(rect.left_center() + vec2(16.0, 0.0), vec2(24.0, 24.0));
    picture::ball(ui.painter(), gallery.thumbnail(name), ball, ui.visuals());
    let at = rect.left_center() + vec2(36.0, 0.0);
    let painter = painter.with_clip_rect(rect.intersect(ui.clip_rect()));
    painter.text(at, Align2::LEFT_CENTER, shown(name), FontId::proportional(12.5), visuals.text_color());
    row.on_hover_text(name)
}
