//! Pictures as they are painted everywhere.

use egui::{Color32, Painter, Rect, TextureHandle, Visuals, pos2};

/// Paints all of a texture.
pub fn whole(painter: &Painter, texture: &TextureHandle, rect: Rect, tint: Color32) {
    painter.image(texture.id(), rect, Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0)), tint);
}

/// Paints the picture of a material, or a quiet disc until it is there.
pub fn ball(painter: &Painter, texture: Option<&TextureHandle>, rect: Rect, visuals: &Visuals) {
    match texture {
        Some(texture) => whole(painter, texture, rect, Color32::WHITE),
        None => {
            let quiet = visuals.weak_text_color().gamma_multiply(0.12);
            painter.circle_filled(rect.center(), 0.495 * rect.width(), quiet);
        }
    }
}
