//! The mark of the picked point, on every sphere.

use egui::{Color32, Painter, Rect, Stroke, Ui, Vec2, vec2};

use super::Session;

/// From its middle to the ends of its arms, and to where they begin \[points\].
const ARMS: [f32; 2] = [4.0, 10.0];

/// Whether what is dragged now is the point, not the light.
pub fn is_asked(ui: &Ui, session: &Session) -> bool {
    session.pick.is_picking || ui.input(|input| input.modifiers.alt || input.modifiers.command)
}

/// A cross hair over a picture that shows a sphere.
pub fn mark(ui: &Ui, rect: Rect, session: &Session) {
    let Some(place) = session.pick.at else { return };
    let [x, y] = session.look.scenery.frame.seen_at(place.map(f64::from)).map(|along| along as f32);
    if x.abs() > 1.0 || y.abs() > 1.0 {
        return;
    }
    let at = rect.center() + vec2(x, -y) * (rect.width() / 2.0);
    let cross = |painter: &Painter, stroke: Stroke| {
        for way in [Vec2::RIGHT, Vec2::DOWN, Vec2::LEFT, Vec2::UP] {
            painter.line_segment([at + way * ARMS[0], at + way * ARMS[1]], stroke);
        }
    };
    // Seen on white and on black.
    cross(ui.painter(), Stroke::new(3.5, Color32::from_black_alpha(160)));
    cross(ui.painter(), Stroke::new(1.5, Color32::WHITE));
}
