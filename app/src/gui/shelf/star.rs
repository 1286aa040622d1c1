//! The star of a favourite.

use std::f32::consts::TAU;

use egui::{Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2};

use crate::gui::session::Listing;

/// Side of what can be clicked \[points\].
const SIDE: f32 = 16.0;

/// The star in a corner of an entry, seen where it is set or the entry is pointed at.
pub fn show(ui: &mut Ui, listing: &mut Listing, corner: Pos2, name: &str, is_pointed_at: bool) {
    let is_on = listing.favourites.contains(name);
    let rect = Rect::from_min_size(corner, Vec2::splat(SIDE));
    let button = ui.interact(rect, ui.scope_id().with("favourite"), Sense::click());
    let label = format!("{name} as favourite");
    button.widget_info(|| WidgetInfo::selected(egui::Role::CheckBox, true, is_on, &label));
    if is_on || is_pointed_at || button.has_focus() {
        let colour = ui.visuals().warn_fg_color;
        let lit = if is_on || button.hovered() { 1.0 } else { 0.5 };
        paint(ui, rect.center(), colour.gamma_multiply(lit), is_on);
    }
    if button.on_hover_text(if is_on { "No favourite any more" } else { "Make a favourite" }).clicked() {
        listing.toggle_favourite(name);
    }
}

/// Five points up: the small built-in fonts have no star.
fn paint(ui: &Ui, centre: Pos2, colour: egui::Color32, is_filled: bool) {
    let corner = |k: u8| {
        let radius = if k.is_multiple_of(2) { 6.5 } else { 2.8 };
        let (sin, cos) = (TAU * f32::from(k) / 10.0).sin_cos();
        centre + radius * vec2(sin, -cos)
    };
    let corners: Vec<Pos2> = (0..10).map(corner).collect();
    let painter = ui.painter();
    // Seen on bright and on dark pictures alike.
    painter.circle_filled(centre, SIDE / 2.0, ui.visuals().panel_fill.gamma_multiply(0.7));
    if is_filled {
        for k in 0..10 {
            let triangle = vec![centre, corners[k], corners[(k + 1) % 10]];
            painter.add(Shape::convex_polygon(triangle, colour, Stroke::NONE));
        }
    }
    painter.add(Shape::closed_line(corners, Stroke::new(1.0, colour)));
}
