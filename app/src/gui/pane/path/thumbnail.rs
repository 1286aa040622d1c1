//! The small picture of a material.

use egui::{Color32, Rect, Ui, pos2};

use crate::gui::Gallery;

/// Paints it, or a disc until it is there.
pub fn paint(ui: &Ui, gallery: &Gallery, name: &str, rect: Rect) {
    match gallery.thumbnail(name) {
        Some(texture) => {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
        }
        None => {
            let quiet = ui.visuals().weak_text_color().gamma_multiply(0.2);
            ui.painter().circle_filled(rect.center(), 0.5 * rect.width(), quiet);
        }
    }
}
