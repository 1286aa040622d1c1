//! The button that walks the path by itself.

use egui::{Button, Pos2, Rect, Shape, Stroke, Ui, WidgetInfo, vec2};

use crate::gui::Session;
use crate::gui::action::Action;

pub fn show(ui: &mut Ui, session: &mut Session) {
    let is_playing = session.blend.playing.is_some();
    let name = if is_playing { "Pause" } else { "Play" };
    let button = ui.add(Button::new("").min_size(vec2(34.0, 28.0)));
    icon(ui, button.rect.center(), is_playing);
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, name));
    if button.on_hover_text(format!("{name} ({})", Action::Play.shown_key(ui.ctx()))).clicked() {
        session.blend.toggle_play();
    }
    if session.blend.playing.is_some() {
        ui.ctx().request_repaint();
    }
}

/// A triangle, or two bars: the small built-in fonts have neither.
fn icon(ui: &Ui, centre: Pos2, is_playing: bool) {
    let (painter, colour) = (ui.painter(), ui.visuals().text_color());
    if is_playing {
        for x in [-3.5, 3.5] {
            painter.rect_filled(Rect::from_center_size(centre + vec2(x, 0.0), vec2(3.5, 12.0)), 1.0, colour);
        }
    } else {
        let corners = [vec2(-4.0, -6.5), vec2(7.0, 0.0), vec2(-4.0, 6.5)].map(|corner| centre + corner);
        painter.add(Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE));
    }
}
